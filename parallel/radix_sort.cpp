#include "parallel/radix_sort.h"

#include "parallel/concurrency.h"

#include <algorithm>
#include <array>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace visorder::detail {

namespace {

constexpr int digit_bits = 11;
constexpr std::size_t digits = std::size_t{1} << digit_bits;
constexpr std::size_t worth_a_thread = 1 << 15;

template <class Key>
std::uint32_t digit(Key key, int shift)
{
    return static_cast<std::uint32_t>(key >> shift) & (digits - 1);
}

} // namespace

template <class Key>
void RadixSort<Key>::sort(std::span<const Key> keys, std::span<const std::uint32_t> values,
                          std::span<std::uint32_t> sorted)
{
    constexpr int key_bits = 8 * sizeof(Key);
    constexpr std::size_t passes = (key_bits + digit_bits - 1) / digit_bits;
    const std::size_t n = keys.size();
    const std::size_t chunks = std::clamp<std::size_t>(n / worth_a_thread, 1, concurrency());
    const auto chunk_begin = [&](std::size_t chunk) { return n * chunk / chunks; };
    const auto each_chunk = [&](auto&& body) {
        oneapi::tbb::parallel_for(std::size_t{0}, chunks, body, oneapi::tbb::simple_partitioner());
    };

    // Every chunk's count of every digit, for all passes at once. Only the first pass can use the counts by chunk, for
    // the items have not moved yet; the others know from the sums which digits all keys share.
    counts_.resize(chunks * passes * digits);
    each_chunk([&](std::size_t chunk) {
        std::uint32_t* count = counts_.data() + chunk * passes * digits;
        std::fill_n(count, passes * digits, 0u);
        for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i)
            for (std::size_t pass = 0; pass < passes; ++pass)
                ++count[pass * digits + digit(keys[i], static_cast<int>(pass) * digit_bits)];
    });
    std::vector<std::size_t> needed;
    for (std::size_t pass = 0; pass < passes; ++pass) {
        const std::uint32_t first = n == 0 ? 0 : digit(keys[0], static_cast<int>(pass) * digit_bits);
        std::size_t same = 0;
        for (std::size_t chunk = 0; chunk < chunks; ++chunk)
            same += counts_[(chunk * passes + pass) * digits + first];
        if (same != n)
            needed.push_back(pass);
    }
    if (needed.empty()) {
        std::copy(values.begin(), values.end(), sorted.begin());
        return;
    }
    if (needed.size() > 1) {
        items_.resize(n);
        if (needed.size() > 2)
            other_.resize(n);
    }

    LargeArray<std::uint32_t> by_chunk(chunks * digits);
    const auto starts_from_counts = [&] {
        std::uint32_t start = 0;
        for (std::size_t d = 0; d < digits; ++d)
            for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
                std::uint32_t& count = by_chunk[chunk * digits + d];
                start += std::exchange(count, start);
            }
    };
    for (std::size_t k = 0; k < needed.size(); ++k) {
        const std::size_t pass = needed[k];
        const int shift = static_cast<int>(pass) * digit_bits;
        const bool first = k == 0;
        const bool last = k + 1 == needed.size();
        const Item* from = k % 2 == 1 ? items_.data() : other_.data();
        Item* to = k % 2 == 1 ? other_.data() : items_.data();
        each_chunk([&](std::size_t chunk) {
            std::uint32_t* count = by_chunk.data() + chunk * digits;
            if (first || chunks == 1) {
                std::copy_n(counts_.data() + (chunk * passes + pass) * digits, digits, count);
                return;
            }
            std::fill_n(count, digits, 0u);
            for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i)
                ++count[digit(from[i].key, shift)];
        });
        starts_from_counts();
        each_chunk([&](std::size_t chunk) {
            std::uint32_t* start = by_chunk.data() + chunk * digits;
            const std::size_t begin = chunk_begin(chunk), end = chunk_begin(chunk + 1);
            if (first && last)
                for (std::size_t i = begin; i < end; ++i)
                    sorted[start[digit(keys[i], shift)]++] = values[i];
            else if (first)
                for (std::size_t i = begin; i < end; ++i)
                    to[start[digit(keys[i], shift)]++] = {keys[i], values[i]};
            else if (last)
                for (std::size_t i = begin; i < end; ++i)
                    sorted[start[digit(from[i].key, shift)]++] = from[i].value;
            else
                for (std::size_t i = begin; i < end; ++i)
                    to[start[digit(from[i].key, shift)]++] = from[i];
        });
    }
}

template class RadixSort<std::uint32_t>;
template class RadixSort<std::uint64_t>;

} // namespace visorder::detail
