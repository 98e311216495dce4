#pragma once

#include "visorder/mesh.h"

#include <array>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

namespace visorder::tests {

// Small meshes that the tests share.

inline void add_tetrahedron(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
    mesh.add(CellShape::tetrahedron, std::array{a, b, c, d});
}

/// (0,0,0), (1,0,0), (0,1,0), (0,0,1) and (1,1,1): a corner tetrahedron 0 and the one across its far face, 1.
inline Mesh two_tetrahedra()
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    add_tetrahedron(mesh, 0, 1, 2, 3);
    add_tetrahedron(mesh, 1, 2, 3, 4);
    return mesh;
}

/// n x n x n unit cubes, x fastest, without those that `keep` says no to.
template <class Keep>
Mesh cubes(int n, Keep&& keep)
{
    Mesh mesh;
    const auto point = [&](int x, int y, int z) { return static_cast<std::uint32_t>((z * (n + 1) + y) * (n + 1) + x); };
    for (int z = 0; z <= n; ++z)
        for (int y = 0; y <= n; ++y)
            for (int x = 0; x <= n; ++x)
                mesh.points.emplace_back(x, y, z);
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                if (keep(x, y, z))
                    mesh.add(CellShape::hexahedron,
                             std::array{point(x, y, z), point(x + 1, y, z), point(x + 1, y + 1, z), point(x, y + 1, z),
                                        point(x, y, z + 1), point(x + 1, y, z + 1), point(x + 1, y + 1, z + 1),
                                        point(x, y + 1, z + 1)});
    return mesh;
}
inline Mesh cubes(int n)
{
    return cubes(n, [](int, int, int) { return true; });
}

/// One cell of each zoo shape in a row along x, sharing faces: hexahedron, wedge; pyramid on the hexahedron's top with
/// a tetrahedron at its side.
inline Mesh zoo()
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},     {1, 0, 1},
                   {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 0, 1}, {0.5, 0.5, 2}, {2, 0.5, 2}};
    mesh.add(CellShape::hexahedron, std::array{0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u});
    // The wedge between the hexahedron's side x = 1 and the edge x = 2, y = 0.
    mesh.add(CellShape::wedge, std::array{1u, 2u, 8u, 5u, 6u, 9u});
    mesh.add(CellShape::pyramid, std::array{4u, 5u, 6u, 7u, 10u});
    mesh.add(CellShape::tetrahedron, std::array{5u, 6u, 10u, 11u});
    return mesh;
}

} // namespace visorder::tests
