#pragma once

#include "parallel/large_array.h"
#include "parallel/radix_sort.h"
#include "visorder/sorter.h"

#include <cstdint>

namespace visorder::detail {

/// Sorts cells by the distance of their centre (the mean of the vertices) from the eye, farthest first; in parallel
/// views by its depth. What projected tetrahedra and splatting renderers do. Single-precision keys, radix sort, ties in
/// the Scene's inner order. Never exact; takes every scene.
///
/// Needs centroids. One `sort` at a time on one sorter; any number of sorters on one Scene.
class Centroid final : public Sorter {
public:
    explicit Centroid(const Scene& scene);

    Guarantee guarantee() const override { return Guarantee::approximate; }
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override { return keys_.capacity() * sizeof(std::uint32_t) + radix_sort_.bytes(); }

private:
    Scene scene_;
    LargeArray<std::uint32_t> keys_;
    RadixSort<std::uint32_t> radix_sort_;
};

} // namespace visorder::detail
