#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace visorder {

class Scene;

/// The optical properties of a medium where the scalar has a value.
struct OpticalPoint {
    double scalar;
    double extinction; ///< per unit of length in world coordinates, at least 0
    glm::dvec3 colour; ///< linear, each channel in [0, 1]
};

/// What the reference ray caster takes for the same, of which the renderers know nothing: linear between two points,
/// constant beyond the first and the last, and a jump at two points of one scalar. Where the scalar stays at a jump,
/// what is above it holds.
struct MediumPoint {
    double scalar;
    double extinction; ///< per unit of length; what is given off per length is extinction * colour
    glm::dvec3 colour; ///< linear
};

/// Extinction and colour over the scalar. Both are linear between two points and constant beyond the first and the
/// last; two points at the same scalar make a jump there. What the medium gives off per length is extinction times
/// colour: the density emitter model (Max 1995, Optical models for direct volume rendering, section 2.3), in which
/// light along a ray is the integral of extinction * colour * exp(-extinction from the eye so far).
///
/// Immutable; threads may share one.
class TransferFunction {
public:
    /// The points ascend by scalar. Throws InputError, naming the point (counted from 0): none at all, a number that is
    /// NaN or infinite, a negative extinction, a colour outside [0, 1], a scalar below the one before, a third point at
    /// one scalar, scalars so far apart that their difference overflows.
    explicit TransferFunction(std::vector<OpticalPoint> points);

    std::span<const OpticalPoint> points() const { return points_; }

    /// Extinction and colour at a scalar, which is not NaN and may be infinite. At a jump, what holds above it: the
    /// second of the two points, even where they are the first or last two.
    OpticalPoint at(double scalar) const;

private:
    std::vector<OpticalPoint> points_;
};

/// The extinction of a medium, all alike, that hides `opacity` (in [0, 1)) of what is behind `length` (above 0) of it.
double extinction_of(double opacity, double length);

/// The names that named_transfer_function takes.
std::span<const char* const> transfer_function_names();

/// A transfer function by its name, spread over the scalars from `lowest` to `highest`. `unit_length` is the distance
/// over which its opacities hold; a tenth of the scene's diameter shows most of what is inside.
///
/// - cool-warm: opacity rises from 0 to 0.6, from blue over grey to red (Moreland 2009, Diverging color maps)
/// - viridis: opacity rises from 0 to 0.6, from violet over green to yellow
/// - rainbow: opacity 0.3 throughout, from blue over green to red
/// - narrow-peak: a band of opacity 0.98, 2 % of the range wide, over a ramp from 0.01 to 0.1
/// - peak-in-haze: a band of opacity 0.8, 1 % of the range wide, in a haze of 0.5 and of another colour
/// - steps: five bands of their own opacity and colour, jumps between them
/// - constant: one opacity, 0.3, and one colour
///
/// Where lowest = highest, constant: what the name has at its lowest scalar. Throws InputError for an unknown name
/// (and lists those known), scalars that are not finite or descend, a unit length that is not above 0 and finite.
TransferFunction named_transfer_function(std::string_view name, double lowest, double highest, double unit_length);

/// The same over the scalars of a scene. Throws InputError, too, for a scene without any.
TransferFunction named_transfer_function(std::string_view name, const Scene& scene, double unit_length);

} // namespace visorder
