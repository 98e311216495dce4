#pragma once

#include "visorder/checking.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"

#include <cstdint>

namespace visorder::tests {

/// A random order of a scene's cells. If it is to satisfy the relations, it satisfies all but those within strongly
/// connected sets, and nothing else: the members of a set may stand anywhere between what is before and behind each.
Order random_order(const Scene& scene, const Relations& relations, bool satisfy, std::uint64_t seed);

} // namespace visorder::tests
