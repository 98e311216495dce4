#include "scene/face_loop.h"

namespace visorder::detail {

bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    // The plane's normal is zero if it has no component along any axis.
    return side_of_plane(a, b, c, glm::dvec4(1, 0, 0, 0)) == Sign::zero &&
           side_of_plane(a, b, c, glm::dvec4(0, 1, 0, 0)) == Sign::zero &&
           side_of_plane(a, b, c, glm::dvec4(0, 0, 1, 0)) == Sign::zero;
}

std::optional<FaceTriple> spanning_triple(const Mesh& mesh, const FaceLoop& loop)
{
    constexpr std::array<std::array<int, 3>, 4> triples{{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
    for (const auto& [i, j, k] : triples) {
        if (k >= loop.count)
            continue;
        const FaceTriple triple{loop.begin()[i], loop.begin()[j], loop.begin()[k]};
        if (!collinear(mesh.points[triple.a], mesh.points[triple.b], mesh.points[triple.c]))
            return triple;
    }
    return std::nullopt;
}

} // namespace visorder::detail
