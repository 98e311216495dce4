// Every triple of points is tried, except those in a plane that is known to hold a face: cells have few points.

#include "files/convex_hull.h"

#include "geometry/exact_predicates.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace visorder::detail {

namespace {

bool lexicographically_less(const glm::dvec3& a, const glm::dvec3& b)
{
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Sets of points, a bit each.
using Set = std::uint64_t;

class HullOfPoints {
public:
    explicit HullOfPoints(std::vector<PointId> ids, std::span<const glm::dvec3> points)
        : ids_(std::move(ids)), points_(points)
    {
    }

    PolyhedronFaces faces() const
    {
        PolyhedronFaces result;
        std::vector<Set> known;
        for (std::size_t i = 0; i < ids_.size(); ++i)
            for (std::size_t j = i + 1; j < ids_.size(); ++j)
                for (std::size_t k = j + 1; k < ids_.size(); ++k) {
                    const Set triple = bit(i) | bit(j) | bit(k);
                    const bool is_known =
                        std::any_of(known.begin(), known.end(), [&](Set plane) { return (plane & triple) == triple; });
                    if (is_known)
                        continue;
                    if (const auto plane = supporting_plane(i, j, k)) {
                        known.push_back(plane->in_it);
                        result.add(around(*plane));
                    }
                }
        return result;
    }

private:
    /// A plane that has all points on one side, or in it.
    struct Plane {
        Set in_it;
        std::size_t apart; ///< a point that is not
    };

    static Set bit(std::size_t i) { return Set{1} << i; }
    const glm::dvec3& at(std::size_t i) const { return points_[ids_[i]]; }
    Sign side(std::size_t i, std::size_t j, std::size_t k, std::size_t from) const
    {
        return side_of_plane(at(i), at(j), at(k), at(from));
    }

    std::optional<Plane> supporting_plane(std::size_t i, std::size_t j, std::size_t k) const
    {
        Plane plane{0, 0};
        Sign common = Sign::zero;
        for (std::size_t other = 0; other < ids_.size(); ++other) {
            const Sign sign = side(i, j, k, other);
            if (sign == Sign::zero) {
                plane.in_it |= bit(other);
            } else {
                if (common != Sign::zero && sign != common)
                    return {};
                common = sign;
                plane.apart = other;
            }
        }
        if (common == Sign::zero) // the three are collinear, or all points lie in one plane
            return {};
        return plane;
    }

    /// The corners of the convex hull of the points in a plane, clockwise as seen from the point that is not in it.
    std::vector<PointId> around(const Plane& plane) const
    {
        std::vector<std::size_t> in_plane;
        for (std::size_t i = 0; i < ids_.size(); ++i)
            if ((plane.in_it & bit(i)) != 0)
                in_plane.push_back(i);
        const std::size_t first =
            *std::min_element(in_plane.begin(), in_plane.end(),
                              [&](std::size_t a, std::size_t b) { return lexicographically_less(at(a), at(b)); });
        std::vector<PointId> corners;
        for (std::size_t corner = first;;) {
            corners.push_back(ids_[corner]);
            std::size_t next = corner == in_plane.front() ? in_plane.back() : in_plane.front();
            for (const std::size_t other : in_plane) {
                if (other == corner || other == next)
                    continue;
                const Sign sign = side(corner, next, other, plane.apart);
                if (sign == Sign::positive || (sign == Sign::zero && is_beyond(corner, next, other)))
                    next = other;
            }
            corner = next;
            if (corner == first || corners.size() > in_plane.size())
                return corners;
        }
    }

    /// Of three points on a line: whether `other` lies beyond `to` as seen from `from`.
    bool is_beyond(std::size_t from, std::size_t to, std::size_t other) const
    {
        return lexicographically_less(at(from), at(to)) ? lexicographically_less(at(to), at(other))
                                                        : lexicographically_less(at(other), at(to));
    }

    std::vector<PointId> ids_;
    std::span<const glm::dvec3> points_;
};

} // namespace

PolyhedronFaces convex_hull(std::span<const PointId> some, std::span<const glm::dvec3> points)
{
    // Points at the same place would be corners twice.
    std::vector<PointId> ids(some.begin(), some.end());
    std::sort(ids.begin(), ids.end(), [&](PointId a, PointId b) {
        if (points[a] == points[b])
            return a < b;
        return lexicographically_less(points[a], points[b]);
    });
    ids.erase(std::unique(ids.begin(), ids.end(), [&](PointId a, PointId b) { return points[a] == points[b]; }),
              ids.end());
    return HullOfPoints(std::move(ids), points).faces();
}

} // namespace visorder::detail
