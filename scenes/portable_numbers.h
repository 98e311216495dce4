#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <random>

namespace visorder::scenes {

// What the generated scenes compute with, so that a specification gives the same mesh, bit by bit, on every machine:
// the standard library's distributions, sines and roots may differ from one to the next.

/// Random numbers, the same sequence for the same seed.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// In [0, 1), a multiple of 2^-53.
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    glm::dvec3 in_unit_cube();

private:
    std::mt19937_64 engine_;
};

/// The sine and cosine of `turns` full turns; exact at multiples of a quarter turn.
double sine_of_turns(double turns);
double cosine_of_turns(double turns);

/// The cube root of a positive number.
double cube_root(double value);

} // namespace visorder::scenes
