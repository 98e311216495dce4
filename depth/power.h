#pragma once

#include "parallel/large_array.h"
#include "parallel/radix_sort.h"
#include "visorder/sorter.h"

#include <cstdint>

namespace visorder::detail {

/// Sorts cells by the power of the eye with respect to their circumspheres, greatest first (Edelsbrunner 1989; Max,
/// Williams, Silva 2000, section III). In exact arithmetic this is a visibility order of a Delaunay tetrahedralisation
/// and of every subset of one, save for cells on a common sphere, whose powers are equal. Keys are doubles, and
/// rounding them can swap two neighbours whose common face the eye all but lies in: hence never called exact.
///
/// Needs circumspheres. One `sort` at a time on one sorter; any number of sorters on one Scene.
class Power final : public Sorter {
public:
    /// Throws InputError for a surface scene.
    explicit Power(const Scene& scene);

    Guarantee guarantee() const override { return Guarantee::approximate; }
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override { return keys_.capacity() * sizeof(std::uint64_t) + radix_sort_.bytes(); }

private:
    Scene scene_;
    LargeArray<std::uint64_t> keys_;
    RadixSort<std::uint64_t> radix_sort_;
};

} // namespace visorder::detail
