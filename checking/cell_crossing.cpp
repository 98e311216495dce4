#include "checking/cell_crossing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace visorder::detail {

namespace {

// The sign of a b - c d, exact unless products under- or overflow.
int sign_of_difference(double a, double b, double c, double d)
{
    const double ab = a * b;
    const double cd = c * d;
    if (ab != cd)
        return ab > cd ? 1 : -1;
    const double rest = std::fma(a, b, -ab) - std::fma(c, d, -cd);
    return (rest > 0) - (rest < 0);
}

// What is_left says where rounded products are equal.
bool is_left_of_tie(const SeenVertex& a, const SeenVertex& b)
{
    if (const int sign = sign_of_difference(a.x, b.y, b.x, a.y); sign != 0)
        return sign > 0;
    if (const int sign = sign_of_difference(b.w, a.y, a.w, b.y); sign != 0)
        return sign > 0;
    return sign_of_difference(a.w, b.x, b.w, a.x) >= 0;
}

// On which side the line passes the edge from a to b: the sign of the determinant of the line's direction, a and b.
// Moved by (e, e^2), that becomes a polynomial in e, whose first coefficient other than zero decides. If all are zero,
// the edge is seen as a point, and any answer does that is the same for all its cells.
inline bool is_left(const SeenVertex& a, const SeenVertex& b)
{
    const double forth = a.x * b.y;
    const double back = b.x * a.y;
    return forth != back ? forth > back : is_left_of_tie(a, b);
}

struct Hit {
    double depth;
    double scalar;
};

// Where the line meets a face: the vertices weighted with the areas that the edges opposite make with the line, or, if
// the line is in the face's plane, with how these change as it leaves it.
Hit hit(const SeenVertex& a, const SeenVertex& b, const SeenVertex& c)
{
    const auto area = [](const SeenVertex& p, const SeenVertex& q) { return std::abs(p.x * q.y - q.x * p.y); };
    const auto by_x = [](const SeenVertex& p, const SeenVertex& q) { return std::abs(q.w * p.y - p.w * q.y); };
    const auto by_y = [](const SeenVertex& p, const SeenVertex& q) { return std::abs(p.w * q.x - q.w * p.x); };
    double of_a = area(b, c), of_b = area(c, a), of_c = area(a, b);
    if (of_a + of_b + of_c == 0)
        of_a = by_x(b, c), of_b = by_x(c, a), of_c = by_x(a, b);
    if (of_a + of_b + of_c == 0)
        of_a = by_y(b, c), of_b = by_y(c, a), of_c = by_y(a, b);
    if (of_a + of_b + of_c == 0)
        of_a = of_b = of_c = 1;
    const double sum = of_a + of_b + of_c;
    return {(of_a * a.depth + of_b * b.depth + of_c * c.depth) / sum,
            (of_a * a.scalar + of_b * b.scalar + of_c * c.scalar) / sum};
}

} // namespace

bool cross(const std::array<SeenVertex, 4>& v, Crossing& crossing)
{
    const bool left01 = is_left(v[0], v[1]), left02 = is_left(v[0], v[2]), left03 = is_left(v[0], v[3]);
    const bool left12 = is_left(v[1], v[2]), left13 = is_left(v[1], v[3]), left23 = is_left(v[2], v[3]);
    // A face is hit where the line passes all its edges, taken in a round, on one side.
    const bool hits[] = {left12 == left23 && left12 != left13, left02 == left23 && left02 != left03,
                         left01 == left13 && left01 != left03, left01 == left12 && left01 != left02};
    Hit ends[2];
    int count = 0;
    for (std::size_t opposite = 0; opposite < 4; ++opposite)
        if (hits[opposite])
            ends[count++] = hit(v[opposite == 0 ? 1 : 0], v[opposite <= 1 ? 2 : 1], v[opposite <= 2 ? 3 : 2]);
    if (count == 0)
        return false;
    // One face alone is hit only if the eye is at a vertex, where all edges are seen as points: there the other end is.
    if (count == 1) {
        const SeenVertex& opposite = v[std::find(std::begin(hits), std::end(hits), true) - std::begin(hits)];
        if (opposite.x != 0 || opposite.y != 0 || opposite.w != 0)
            return false;
        ends[1] = {opposite.depth, opposite.scalar};
    }
    if (ends[0].depth > ends[1].depth)
        std::swap(ends[0], ends[1]);
    crossing = {{ends[0].depth, ends[1].depth}, {ends[0].scalar, ends[1].scalar}};
    return ends[0].depth < ends[1].depth;
}

} // namespace visorder::detail
