#pragma once

#include "visorder/transfer_function.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Light that reaches the eye from what a ray has passed so far, and the part of all behind that will.
struct Light {
    glm::dvec3 colour{0};
    double transmittance = 1;
};

/// Integrates light along pieces of a ray on which the scalar is linear. Splits them at the medium's points, so that
/// extinction e and colour c are linear on each part; by parts,
///
///     integral of e c exp(-tau) = c0 (1 - E) + (c1 - c0) (M - E),   M = mean of exp(-tau), E = exp(-tau at the end),
///
/// with tau quadratic. M is found by Gauss-Legendre quadrature with eight points over stretches of optical depth 1/2 at
/// most, on which its error is below 2e-12 (of the ellipse with sum of half axes 9, in which |exp(-tau)| < 760).
///
/// Immutable; threads may share one.
class MediumIntegral {
public:
    /// Throws InputError, naming the point, for none at all, numbers that are not finite, negative extinction, scalars
    /// that descend, and more than two at one.
    explicit MediumIntegral(std::span<const MediumPoint> points);

    /// Takes light on through `length`, along which the scalar runs from `first` to `last`.
    void pass(Light& light, double length, double first, double last) const;

    /// Below this transmittance nothing behind counts, and a ray may end.
    static constexpr double opaque = 1e-18;

private:
    struct Properties {
        double extinction;
        glm::dvec3 colour;
    };

    Properties between(std::size_t above, double scalar) const;
    static void pass_linear(Light& light, double length, const Properties& first, const Properties& last);

    std::vector<MediumPoint> points_;
};

} // namespace visorder::detail
