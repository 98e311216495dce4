#pragma once

#include "checking/ray_sequence.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace visorder::detail {

/// The point that the ray with this number goes through, of the endless sequence that `seed` starts (see RayAudit).
/// Any point makes a ray, so nothing here is exact; it depends on the arguments alone.
glm::dvec3 audit_point(const RayTracer& tracer, std::uint64_t seed, std::uint64_t number);

} // namespace visorder::detail
