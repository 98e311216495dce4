#pragma once

#include "visorder/scene.h"

namespace visorder::detail {

Traits derive_traits(const Scene& scene);

} // namespace visorder::detail
