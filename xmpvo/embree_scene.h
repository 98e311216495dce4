#pragma once

#include "sorting/face_pairs.h"
#include "xmpvo/boundary_surface.h"
#include "xmpvo/ray_set.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace visorder::detail {

/// A boundary in Embree (Wald et al. 2014), to be shot at: single precision, watertight between faces that share edges.
/// Owns an Embree device of its own, for as long as it lives; what Embree reports as an error becomes an exception
/// (std::bad_alloc, or std::runtime_error with Embree's words). Any number of threads may shoot at one.
class EmbreeScene {
public:
    explicit EmbreeScene(const BoundarySurface& surface);

    /// All faces that each of a few rays meets, nearest first, each once; reuses the memory of `hits`. What grazes an
    /// edge, or a face seen edge-on, may be missed or found.
    void shoot(std::span<const Ray> rays, std::array<std::vector<RayHit>, most_rays>& hits) const;

    /// What Embree holds.
    std::size_t bytes() const { return static_cast<std::size_t>(held_->load()); }

private:
    struct Release {
        void operator()(RTCDeviceTy* device) const;
        void operator()(RTCSceneTy* scene) const;
    };

    std::unique_ptr<std::atomic<std::ptrdiff_t>> held_;
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> scene_;
};

} // namespace visorder::detail
