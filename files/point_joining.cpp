#include "files/point_joining.h"

#include "visorder/mesh.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

namespace visorder::detail {

namespace {

struct CoordinatesLess {
    std::span<const glm::dvec3> points;

    /// Total even where coordinates are NaN, which then are equal to none: by coordinates, then by number.
    bool operator()(PointId a, PointId b) const
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto x = key(points[a][axis]);
            const auto y = key(points[b][axis]);
            if (x != y)
                return x < y;
        }
        return a < b;
    }

    /// Some order of numbers; 0.0 and -0.0 are equal.
    static std::uint64_t key(double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }
};

/// Points in sets of equal ones, each set ascending. `visit(set)` for each set.
template <class Visit>
void for_equal_sets(std::span<const glm::dvec3> points, const Visit& visit)
{
    std::vector<PointId> sorted(points.size());
    std::iota(sorted.begin(), sorted.end(), PointId{0});
    std::sort(sorted.begin(), sorted.end(), CoordinatesLess{points});
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
        end = begin + 1;
        while (end < sorted.size() && points[sorted[begin]] == points[sorted[end]])
            ++end;
        if (end - begin > 1)
            visit(std::span(sorted).subspan(begin, end - begin));
    }
}

/// Numbers the points that represent themselves.
JoinedPoints numbered(const std::vector<PointId>& representative)
{
    JoinedPoints joined;
    joined.number.resize(representative.size());
    for (std::size_t i = 0; i < representative.size(); ++i)
        if (representative[i] == i) {
            joined.number[i] = static_cast<PointId>(joined.kept.size());
            joined.kept.push_back(static_cast<PointId>(i));
        } else {
            joined.number[i] = joined.number[representative[i]]; // a lower one
        }
    return joined;
}

std::vector<PointId> themselves(std::size_t count)
{
    std::vector<PointId> all(count);
    std::iota(all.begin(), all.end(), PointId{0});
    return all;
}

} // namespace

JoinedPoints join_pieces(std::span<const glm::dvec3> points, std::span<const std::size_t> pieces)
{
    std::vector<PointId> representative = themselves(points.size());
    if (pieces.size() > 1) {
        std::vector<PointId> first; // of the set at hand, the points that stay
        for_equal_sets(points, [&](std::span<const PointId> set) {
            first.clear();
            std::size_t piece_end = 0, in_piece = 0;
            for (const PointId point : set) {
                if (point >= piece_end) {
                    const auto next = std::upper_bound(pieces.begin(), pieces.end(), std::size_t{point});
                    piece_end = next == pieces.end() ? points.size() : *next;
                    in_piece = 0;
                }
                if (in_piece < first.size())
                    representative[point] = first[in_piece];
                else
                    first.push_back(point);
                ++in_piece;
            }
        });
    }
    return numbered(representative);
}

JoinedPoints join_all(std::span<const glm::dvec3> points, double tolerance)
{
    // Vertices are renumbered with the points, so they tell what became of each.
    Mesh mesh;
    mesh.points.assign(points.begin(), points.end());
    mesh.vertices = themselves(points.size());
    weld(mesh, tolerance);
    JoinedPoints joined;
    joined.number = std::move(mesh.vertices);
    for (std::size_t i = 0; i < joined.number.size(); ++i)
        if (joined.number[i] == joined.kept.size())
            joined.kept.push_back(static_cast<PointId>(i));
    return joined;
}

} // namespace visorder::detail
