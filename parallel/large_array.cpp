#include "parallel/large_array.h"

#include <cstdint>
#include <cstdlib>
#include <sys/mman.h>

namespace visorder::detail {

namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;
constexpr std::size_t worth_huge_pages = 2 * huge_page;
constexpr std::align_val_t cache_line{64}; // as elements may ask for

} // namespace

void* allocate_large(std::size_t bytes)
{
    if (bytes < worth_huge_pages)
        return ::operator new(bytes, cache_line);
    const std::size_t whole_pages = (bytes + huge_page - 1) / huge_page * huge_page;
    void* memory = std::aligned_alloc(huge_page, whole_pages);
    if (memory == nullptr)
        throw std::bad_alloc();
    // Advice only: where the kernel declines, the memory is good all the same.
    (void)madvise(memory, whole_pages, MADV_HUGEPAGE);
    return memory;
}

void advise_huge_pages(void* memory, std::size_t bytes) noexcept
{
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = (begin + huge_page - 1) / huge_page * huge_page;
    const std::uintptr_t last = (begin + bytes) / huge_page * huge_page;
    if (first < last)
        (void)madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

void free_large(void* memory, std::size_t bytes) noexcept
{
    if (bytes < worth_huge_pages)
        ::operator delete(memory, cache_line);
    else
        std::free(memory);
}

} // namespace visorder::detail
