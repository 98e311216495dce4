#pragma once

#include "apps/scene_source.h"

#include <cstddef>
#include <string>

namespace visorder::apps {

/// Gives every point of a mesh that is to be drawn a finite scalar. Cells with one that is missing (NaN or infinite)
/// are dropped from it for "drop", or get the lowest scalar there is for "lowest"; for "refuse", they throw InputError,
/// as does a mesh of which nothing is left. Returns how many cells were dropped.
std::size_t settle_missing_scalars(SourcedMesh& sourced, const std::string& way);

} // namespace visorder::apps
