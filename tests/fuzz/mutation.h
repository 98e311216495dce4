#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace visorder::tests {

/// A damaged copy of one of some contents: a few bytes or numbers changed, pieces cut out, doubled, moved or exchanged
/// with another one's, or the end cut off. `number` alone decides what happens.
std::string mutated(const std::vector<std::string>& contents, std::uint64_t number);

} // namespace visorder::tests
