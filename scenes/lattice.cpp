#include "scenes/lattice.h"

#include "scenes/portable_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace visorder::scenes {

namespace {

// The counts worth trying where `ideal` is what the proportions ask for.
std::array<std::size_t, 4> candidates(double ideal, std::size_t least)
{
    const auto below = static_cast<std::size_t>(ideal);
    return {std::max(least, below - std::min<std::size_t>(below, 1)), std::max(least, below),
            std::max(least, below + 1), std::max(least, below + 2)};
}

} // namespace

LatticeSize lattice_size(std::size_t count, const glm::dvec3& proportions, const LatticeSize& least)
{
    const auto wanted = static_cast<double>(count);
    const glm::dvec3 ideal = cube_root(wanted / (proportions.x * proportions.y * proportions.z)) * proportions;
    LatticeSize best = least;
    double lowest_cost = std::numeric_limits<double>::max();
    for (const std::size_t nx : candidates(ideal.x, least[0]))
        for (const std::size_t ny : candidates(ideal.y, least[1])) {
            const auto x = static_cast<double>(nx);
            const auto y = static_cast<double>(ny);
            const std::size_t nz = std::max(least[2], static_cast<std::size_t>(wanted / (x * y) + 0.5));
            const auto z = static_cast<double>(nz);
            const double miss = std::abs(x * y * z / wanted - 1);
            const double distortion = std::abs(x / ideal.x - 1) + std::abs(y / ideal.y - 1) + std::abs(z / ideal.z - 1);
            // The count matters more than the proportions, but one in a hundred is not worth a distortion.
            const double cost = miss + 0.1 * distortion;
            if (cost < lowest_cost) {
                lowest_cost = cost;
                best = {nx, ny, nz};
            }
        }
    return best;
}

void add_hexahedra(Mesh& mesh, const LatticeSize& points, bool closed)
{
    add_hexahedra(mesh, points, closed, [](const LatticeSize&) { return true; });
}

void add_hexahedra(Mesh& mesh, const LatticeSize& points, bool closed,
                   const std::function<bool(const LatticeSize& corner)>& keep)
{
    const std::size_t first = mesh.points.size() - points[0] * points[1] * points[2];
    const std::size_t rows = closed ? points[1] : points[1] - 1;
    const auto number = [&](std::size_t i, std::size_t j, std::size_t k) {
        return static_cast<PointId>(first + i + points[0] * (j % points[1] + points[1] * k));
    };
    for (std::size_t k = 0; k + 1 < points[2]; ++k)
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i + 1 < points[0]; ++i) {
                if (!keep({i, j, k}))
                    continue;
                const std::array<PointId, 8> vertices{
                    number(i, j, k),     number(i + 1, j, k),     number(i + 1, j + 1, k),     number(i, j + 1, k),
                    number(i, j, k + 1), number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1)};
                mesh.add(CellShape::hexahedron, vertices);
            }
}

} // namespace visorder::scenes
