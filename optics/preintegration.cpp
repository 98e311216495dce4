#include "optics/preintegration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

// A part of a way on which extinction and colour are linear. Shares of the whole way's length.
struct Part {
    double share;
    double first_extinction, last_extinction;
    glm::dvec3 first_colour, last_colour;
};

template <class Visit>
void visit_parts(const OpticalPieces& function, double front, double back, Visit&& visit)
{
    const OpticalPieces::Piece* piece = &function.at(front);
    const double rise = back - front;
    double done = 0;
    for (;;) {
        const double limit = rise > 0 ? piece->end : piece->begin;
        const bool last = rise == 0 || (rise > 0 ? back <= limit : back >= limit);
        const double end = last ? 1 : std::clamp((limit - front) / rise, done, 1.0);
        const double s0 = front + done * rise - piece->begin;
        const double s1 = front + end * rise - piece->begin;
        const glm::dvec3 colour(piece->colour);
        const glm::dvec3 slope(piece->colour_slope);
        visit(Part{end - done, piece->extinction + s0 * piece->extinction_slope,
                   piece->extinction + s1 * piece->extinction_slope, colour + s0 * slope, colour + s1 * slope});
        if (last)
            return;
        done = end;
        piece += rise > 0 ? 1 : -1;
    }
}

// Below this transmittance nothing behind counts.
constexpr double opaque = 1e-12;

// By parts, the integral of e c exp(-t) is c0 (1 - E) + (c1 - c0) (M - E), where E is exp(-t) at the end and M its
// mean, by Gauss's rule with four points over stretches of an optical depth of 1 at most: the farther end of each is
// where t, which is quadratic, has risen by so much. What is beyond some thirty of them is not seen.
void pass(glm::dvec3& light, double& transmittance, double length, const Part& part)
{
    constexpr std::array<double, 4> places{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                           0.93056815579702629};
    constexpr std::array<double, 4> weights{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                            0.17392742256872693};
    const double rise = (part.last_extinction - part.first_extinction) * length;
    const glm::dvec3 change = part.last_colour - part.first_colour;
    bool last = false;
    for (double done = 0; !last && transmittance > opaque;) {
        const double density = std::max(part.first_extinction * length + done * rise, 0.0);
        double way = 1 - done;
        last = way * (density + 0.5 * rise * way) <= 1;
        if (!last)
            way = std::min(way, 2 / (density + std::sqrt(std::max(density * density + 2 * rise, 0.0))));
        const double a = -way * density;
        const double b = -0.5 * way * way * rise;
        const double opacity = -std::expm1(a + b);
        double mean = 0;
        for (std::size_t k = 0; k < places.size(); ++k)
            mean += weights[k] * std::exp(places[k] * (a + b * places[k]));
        light +=
            transmittance * ((part.first_colour + done * change) * opacity + way * change * (mean - (1 - opacity)));
        transmittance *= 1 - opacity;
        done += way;
    }
}

double at(std::size_t k, std::size_t count)
{
    return static_cast<double>(k) / static_cast<double>(count - 1);
}

} // namespace

glm::dvec4 light_along(const OpticalPieces& pieces, double front, double back, double length)
{
    glm::dvec3 light(0);
    double transmittance = 1;
    visit_parts(pieces, front, back, [&](const Part& part) { pass(light, transmittance, part.share * length, part); });
    return {light, 1 - transmittance};
}

double mean_extinction(const OpticalPieces& pieces, double front, double back)
{
    double sum = 0;
    visit_parts(pieces, front, back,
                [&](const Part& part) { sum += part.share * 0.5 * (part.first_extinction + part.last_extinction); });
    return sum;
}

std::vector<glm::vec4> preintegrated_2d(const OpticalPieces& pieces, std::size_t size, double length)
{
    std::vector<glm::vec4> table(size * size);
    oneapi::tbb::parallel_for(std::size_t{0}, size, [&](std::size_t back) {
        for (std::size_t front = 0; front < size; ++front)
            table[back * size + front] = glm::vec4(light_along(pieces, at(front, size), at(back, size), length));
    });
    return table;
}

std::vector<glm::vec4> preintegrated_3d(const OpticalPieces& pieces, std::size_t size, std::span<const double> lengths)
{
    std::vector<glm::vec4> table(size * size * lengths.size());
    oneapi::tbb::parallel_for(std::size_t{0}, size, [&](std::size_t back) {
        for (std::size_t front = 0; front < size; ++front) {
            const double s0 = at(front, size);
            const double s1 = at(back, size);
            const double extinction = mean_extinction(pieces, s0, s1);
            // Of no length at all: the mean of what is given off.
            glm::dvec3 emission(0);
            visit_parts(pieces, s0, s1, [&](const Part& p) {
                emission += p.share / 6.0 *
                            (p.first_extinction * (2.0 * p.first_colour + p.last_colour) +
                             p.last_extinction * (p.first_colour + 2.0 * p.last_colour));
            });
            for (std::size_t k = 0; k < lengths.size(); ++k) {
                const double length = lengths[k];
                glm::dvec3 density = emission;
                if (std::isinf(length))
                    density = glm::dvec3(0);
                else if (length > 0)
                    density = glm::dvec3(light_along(pieces, s0, s1, length)) / length;
                table[(k * size + back) * size + front] = glm::vec4(glm::vec3(density), static_cast<float>(extinction));
            }
        }
    });
    return table;
}

LengthAxis length_axis(std::size_t count, double longest, bool exponential)
{
    LengthAxis axis;
    const auto steps = static_cast<double>(count - 1);
    // The longest way is the last but one of the table: the last is infinite.
    axis.scale = exponential ? std::log2(steps) / longest : 1 / longest;
    for (std::size_t k = 0; k < count; ++k) {
        const double y = at(k, count);
        const double l = exponential ? -std::log2(1 - y) : y;
        axis.lengths.push_back(k + 1 == count && exponential ? std::numeric_limits<double>::infinity()
                                                             : l / axis.scale);
    }
    return axis;
}

} // namespace visorder::detail
