#include "parallel/radix_sort.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <oneapi/tbb/global_control.h>
#include <random>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

template <class Key>
void expect_stable_sort(std::vector<Key> keys, const char* what)
{
    std::vector<std::uint32_t> values(keys.size()), expected(keys.size()), sorted(keys.size());
    std::iota(values.begin(), values.end(), 100u);
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
    for (std::uint32_t& v : expected)
        v += 100;
    RadixSort<Key> radix_sort;
    for (int threads : {1, 2, 3}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        radix_sort.sort(keys, values, sorted);
        EXPECT_EQ(sorted, expected) << what << ", " << threads << " threads";
    }
}

template <class Key>
void expect_all_kinds_sorted()
{
    std::mt19937_64 random(7);
    for (std::size_t n : {0u, 1u, 2u, 1000u, 70'000u, 150'000u}) {
        std::vector<Key> keys(n);
        std::generate(keys.begin(), keys.end(), [&] { return static_cast<Key>(random()); });
        expect_stable_sort(keys, "random");
        for (Key& key : keys)
            key &= 0x7;
        expect_stable_sort(keys, "many ties");
        std::fill(keys.begin(), keys.end(), Key{5});
        expect_stable_sort(keys, "all equal");
        std::generate(keys.begin(), keys.end(), [&] { return static_cast<Key>(random() << 22); });
        expect_stable_sort(keys, "high digits only");
        std::generate(keys.begin(), keys.end(), [&] { return static_cast<Key>((random() & 0x7ff) << 11 | 3); });
        expect_stable_sort(keys, "one digit");
    }
}

TEST(RadixSort, SortsEveryKindOf32BitKeysStablyOnAnyNumberOfThreads)
{
    expect_all_kinds_sorted<std::uint32_t>();
}
TEST(RadixSort, SortsEveryKindOf64BitKeysStablyOnAnyNumberOfThreads)
{
    expect_all_kinds_sorted<std::uint64_t>();
}

} // namespace
} // namespace visorder::tests
