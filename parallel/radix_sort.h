#pragma once

#include "parallel/large_array.h"

#include <cstdint>
#include <span>

namespace visorder::detail {

/// Sorts 32-bit values by unsigned keys: least significant digit first, 11 bits a pass, stable, on all the threads of
/// the current arena, with the same result for any number of them. Passes over a digit that all keys share are skipped.
/// Keeps its memory from call to call. One `sort` at a time on one object.
template <class Key>
class RadixSort {
public:
    /// Writes `values` to `sorted` in ascending order of `keys`; all three are of one length.
    void sort(std::span<const Key> keys, std::span<const std::uint32_t> values, std::span<std::uint32_t> sorted);

    std::size_t bytes() const { return (items_.capacity() + other_.capacity()) * sizeof(Item); }

private:
    struct Item {
        Key key;
        std::uint32_t value;
    };

    LargeArray<Item> items_;
    LargeArray<Item> other_;
    LargeArray<std::uint32_t> counts_;
};

extern template class RadixSort<std::uint32_t>;
extern template class RadixSort<std::uint64_t>;

} // namespace visorder::detail
