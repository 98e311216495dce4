#include "scene/boundary.h"

#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "visorder/scene.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace visorder::detail {

namespace {

// A side of a boundary face that other boundary faces may share: an edge, or (of an edge in a surface scene) a point.
struct Side {
    PointId low;
    PointId high;
    std::uint32_t face; // index into Boundary::faces
};

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

} // namespace

Boundary derive_boundary(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    const Adjacency& adjacency = scene.adjacency();
    const int least = scene.is_surface() ? 2 : 3;
    const std::int8_t* const signs = scene.is_surface() ? nullptr : scene.orientations().sign.data();
    Boundary boundary;
    std::vector<Side> sides;
    for (CellId cell = 0; cell < scene.cell_count(); ++cell) {
        const int faces = face_count(mesh.shapes[cell]);
        if (adjacency.interior[cell] == (1u << faces) - 1 || is_collapsed(mesh, cell) ||
            (signs != nullptr && signs[cell] == 0))
            continue;
        for (int face = 0; face < faces; ++face) {
            if ((adjacency.interior[cell] >> face & 1u) != 0)
                continue;
            const FaceLoop loop = face_loop(mesh, cell, face);
            if (loop.count < least)
                continue;
            const auto index = static_cast<std::uint32_t>(boundary.faces.size());
            boundary.faces.push_back({cell, static_cast<std::uint32_t>(face)});
            for (int i = 0; i < loop.count; ++i) {
                const PointId a = loop.begin()[i];
                const PointId b = scene.is_surface() ? a : loop.begin()[(i + 1) % loop.count];
                sides.push_back({std::min(a, b), std::max(a, b), index});
            }
        }
    }

    std::vector<std::uint32_t> parent(boundary.faces.size());
    std::iota(parent.begin(), parent.end(), 0u);
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
    for (std::size_t i = 1; i < sides.size(); ++i)
        if (sides[i].low == sides[i - 1].low && sides[i].high == sides[i - 1].high) {
            const std::uint32_t a = root(parent, sides[i - 1].face), b = root(parent, sides[i].face);
            parent[std::max(a, b)] = std::min(a, b);
        }

    // Roots come before what they stand for, so every component is numbered at its first face.
    boundary.component.resize(boundary.faces.size());
    for (std::uint32_t i = 0; i < parent.size(); ++i) {
        const std::uint32_t r = root(parent, i);
        boundary.component[i] = r == i ? boundary.component_count++ : boundary.component[r];
    }
    return boundary;
}

} // namespace visorder::detail
