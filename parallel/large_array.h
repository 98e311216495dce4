#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace visorder::detail {

/// Memory for arrays that are read in scattered order: 2 MiB aligned and advised to be on huge pages, which spares most
/// of the address-translation misses of a sort over millions of cells. Small requests are aligned to 64 bytes.
void* allocate_large(std::size_t bytes);
void free_large(void* memory, std::size_t bytes) noexcept;

/// Advises huge pages for memory that is about to be used for the first time; does nothing for small blocks.
void advise_huge_pages(void* memory, std::size_t bytes) noexcept;

/// Resizes a plain vector whose contents may be lost, with the same advice where it has to grow for that.
template <class T>
void resize_on_large_pages(std::vector<T>& vector, std::size_t size)
{
    if (size > vector.capacity()) {
        vector.clear();
        vector.shrink_to_fit();
        vector.reserve(size);
        advise_huge_pages(vector.data(), size * sizeof(T));
    }
    vector.resize(size);
}

/// Standard allocator over allocate_large that leaves new elements of trivial types uninitialised: arrays are filled by
/// parallel loops, and pages are first touched there.
template <class T>
struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&)
    {
    }

    T* allocate(std::size_t n) { return static_cast<T*>(allocate_large(n * sizeof(T))); }
    void deallocate(T* p, std::size_t n) noexcept { free_large(p, n * sizeof(T)); }

    template <class U>
    void construct(U* p)
    {
        ::new (static_cast<void*>(p)) U;
    }
    template <class U, class... Args>
    void construct(U* p, Args&&... args)
    {
        ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
    }

    template <class U>
    bool operator==(const LargeAllocator<U>&) const
    {
        return true;
    }
};

/// A vector for millions of elements; `LargeArray<T>(n)` leaves trivial elements uninitialised.
template <class T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

} // namespace visorder::detail
