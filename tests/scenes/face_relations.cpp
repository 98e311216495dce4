#include "tests/scenes/face_relations.h"

#include "geometry/exact_predicates.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>

namespace visorder::tests {

using namespace detail;

namespace {

// Of a face its vertices, sorted; a triangle's last is repeated.
FaceKey key_of(const Mesh& mesh, CellId cell, int face)
{
    FaceKey key{};
    const auto corners = face_vertices(mesh.shapes[cell], face);
    for (std::size_t i = 0; i < key.size(); ++i)
        key[i] = mesh.cell(cell)[corners[std::min(i, corners.size() - 1)]];
    std::sort(key.begin(), key.end());
    return key;
}

} // namespace

std::map<FaceKey, std::vector<Owner>> owners_of_faces(const Mesh& mesh)
{
    std::map<FaceKey, std::vector<Owner>> owners;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face)
            owners[key_of(mesh, cell, face)].push_back({cell, face});
    return owners;
}

Relations relations_across_faces(const Mesh& mesh, const glm::dvec4& eye)
{
    Relations behind(mesh.cell_count());
    for (const auto& [key, owners] : owners_of_faces(mesh)) {
        if (owners.size() != 2)
            continue;
        const auto corners = face_vertices(mesh.shapes[owners[0].cell], owners[0].face);
        const auto point = [&](std::size_t i) { return mesh.points[mesh.cell(owners[0].cell)[corners[i]]]; };
        const Sign side = side_of_plane(point(0), point(1), point(2), eye);
        if (side == Sign::positive) // outside of the first owner
            behind[owners[1].cell].push_back(owners[0].cell);
        if (side == Sign::negative)
            behind[owners[0].cell].push_back(owners[1].cell);
    }
    return behind;
}

glm::dvec3 random_direction(std::mt19937_64& random)
{
    std::uniform_real_distribution<double> coordinate(-1, 1);
    while (true) {
        const glm::dvec3 direction(coordinate(random), coordinate(random), coordinate(random));
        const double length = glm::length(direction);
        if (length <= 1 && length > 0.1)
            return direction / length;
    }
} // namespace

} // namespace visorder::tests
