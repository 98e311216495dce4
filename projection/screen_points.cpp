#include "projection/screen_points.h"

#include <cmath>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

// As a part of the distance of the farthest point. Closer to the plane through the eye, projective depths grow beyond
// what single precision tells apart from one another.
constexpr double least_w = 1e-6;

std::uint8_t sides_of(const ScreenPoint& p, const glm::dvec2& low, const glm::dvec2& high)
{
    // Multiplied by w, so that the comparisons hold behind the eye too: each is linear in space.
    const double x = p.x * p.w;
    const double y = p.y * p.w;
    std::uint8_t bits = 0;
    bits |= x < low.x * p.w ? sides::left : 0;
    bits |= x > high.x * p.w ? sides::right : 0;
    bits |= y < low.y * p.w ? sides::below : 0;
    bits |= y > high.y * p.w ? sides::above : 0;
    bits |= p.w <= 0 ? sides::behind : 0;
    return bits;
}

} // namespace

void ScreenPoints::place(const Screen& screen, const RasterLattice& lattice, std::span<const glm::dvec3> points)
{
    at.resize(points.size());
    snapped.resize(points.size());
    sides.resize(points.size());
    // A pixel more than the image: what is drawn is a little larger.
    const glm::dvec2 low = -glm::dvec2(screen.centre()) - 1.0;
    const glm::dvec2 high = glm::dvec2(screen.size() - screen.centre()) + 1.0;
    // Room for the corners of what is drawn, which lie outside the cell.
    constexpr double margin = 64;
    const double half_range = lattice.half_range - margin;
    const double steps = lattice.steps;
    using Range = oneapi::tbb::blocked_range<std::size_t>;
    oneapi::tbb::parallel_for(Range(0, points.size(), 4096), [&](const Range& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const ScreenPoint p = screen.seen(points[i]);
            std::uint8_t bits = sides_of(p, low, high);
            // Written so that what is not a number is off the lattice.
            if (!(p.w > least_w && std::abs(p.x) < half_range && std::abs(p.y) < half_range)) {
                bits |= sides::off_lattice;
                at[i] = glm::dvec3(0);
                snapped[i] = glm::ivec2(0);
            } else {
                at[i] = glm::dvec3(p.x, p.y, p.depth);
                snapped[i] = {std::lrint(p.x * steps), std::lrint(p.y * steps)};
            }
            sides[i] = bits;
        }
    });
}

} // namespace visorder::detail
