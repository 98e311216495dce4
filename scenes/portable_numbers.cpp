#include "scenes/portable_numbers.h"

#include <cmath>

namespace visorder::scenes {

namespace {

constexpr double quarter_turn = 1.57079632679489661923;

// Taylor's series up to an eighth of a turn either way, where the first term left out is below 1e-17.
double short_sine(double angle)
{
    const double square = angle * angle;
    double sum = 0;
    for (int n = 17; n >= 3; n -= 2)
        sum = (1 + sum) * -square / (n * (n - 1));
    return angle + angle * sum;
}

double short_cosine(double angle)
{
    const double square = angle * angle;
    double sum = 0;
    for (int n = 18; n >= 2; n -= 2)
        sum = (1 + sum) * -square / (n * (n - 1));
    return 1 + sum;
}

} // namespace

glm::dvec3 Random::in_unit_cube()
{
    // One statement each: the order in which the arguments of a constructor are evaluated is not specified.
    const double x = uniform();
    const double y = uniform();
    const double z = uniform();
    return {x, y, z};
}

double sine_of_turns(double turns)
{
    const double quarters = 4 * (turns - std::floor(turns));
    const double nearest = std::floor(quarters + 0.5);
    const double angle = (quarters - nearest) * quarter_turn;
    switch (static_cast<int>(nearest)) {
    case 1:
        return short_cosine(angle);
    case 2:
        return -short_sine(angle);
    case 3:
        return -short_cosine(angle);
    default:
        return short_sine(angle);
    }
}

double cosine_of_turns(double turns)
{
    return sine_of_turns(turns + 0.25);
}

double cube_root(double value)
{
    // Newton's method falls monotonically from any start above the root, until rounding stops it.
    double root = value < 1 ? 1 : value;
    while (true) {
        const double next = (2 * root + value / (root * root)) / 3;
        if (!(next < root))
            return root;
        root = next;
    }
}

} // namespace visorder::scenes
