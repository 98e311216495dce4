#include "projection/silhouette.h"

#include <bit>
#include <cmath>
#include <cstddef>

namespace visorder::detail {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

// The share of a point is the area of the triangle of the others in ascending order, negative of points 1 and 3.
bool ascending_are_counterclockwise(unsigned left_out, bool positive_share)
{
    return (left_out % 2 == 0) == positive_share;
}

// By which points have a positive and which a negative share in the affine dependency (bit i: point i).
Silhouette by_signs(unsigned positive, unsigned negative)
{
    Silhouette result;
    constexpr unsigned everything = 15;
    std::size_t next = 0;
    const auto put = [&](unsigned bits) {
        for (std::uint8_t i = 0; i < 4; ++i)
            if ((bits >> i & 1) != 0)
                result.points[next++] = i;
    };
    if (std::popcount(positive) == 2 && std::popcount(negative) == 2) {
        result.kind = SilhouetteClass::quad;
        put(positive);
        put(negative);
        result.first_behind = true;
        const auto [a, b, c, d] = result.points;
        const bool reordered = (a > c) != (c > b); // of a, c, b
        result.counterclockwise = ascending_are_counterclockwise(d, false) != reordered;
    } else if (std::popcount(positive) == 1 || std::popcount(negative) == 1) {
        const unsigned inner = std::popcount(positive) == 1 ? positive : negative;
        result.kind = SilhouetteClass::triangle;
        put(inner);
        put(everything & ~inner);
        result.first_behind = inner == positive;
        result.counterclockwise = ascending_are_counterclockwise(result.points[0], inner == positive);
    }
    return result;
}

constexpr std::size_t sign_patterns = 256;

std::array<Silhouette, sign_patterns> all_patterns()
{
    std::array<Silhouette, sign_patterns> table;
    for (unsigned positive = 0; positive < 16; ++positive)
        for (unsigned negative = 0; negative < 16; ++negative)
            if ((positive & negative) == 0)
                table[positive << 4 | negative] = by_signs(positive, negative);
    return table;
}

} // namespace

Silhouette silhouette_of(const std::array<glm::dvec2, 4>& points)
{
    static const std::array<Silhouette, sign_patterns> table = all_patterns();
    const glm::dvec2 first = points[1] - points[0];
    const glm::dvec2 second = points[2] - points[0];
    const glm::dvec2 third = points[3] - points[0];
    std::array<double, 4> share{0, -cross(second, third), -cross(third, first), -cross(first, second)};
    share[0] = -(share[1] + share[2] + share[3]);
    unsigned positive = 0;
    unsigned negative = 0;
    for (unsigned i = 0; i < 4; ++i) {
        positive |= static_cast<unsigned>(share[i] > 0) << i;
        negative |= static_cast<unsigned>(share[i] < 0) << i;
    }
    Silhouette result = table[positive << 4 | negative];
    for (std::size_t i = 0; i < 4; ++i)
        result.areas[i] = std::abs(share[result.points[i]]);
    return result;
}

} // namespace visorder::detail
