// Takes results of the reader's process apart: that may have been upset by the file it read.

#include "files/mesh_file_bytes.h"
#include "visorder/error.h"

#include <algorithm>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::span<const std::byte> left(reinterpret_cast<const std::byte*>(data), size);
    const auto read = [&](std::span<std::byte> to) {
        if (to.size() > left.size())
            throw visorder::InputError("ended");
        std::copy_n(left.begin(), to.size(), to.begin());
        left = left.subspan(to.size());
    };
    try {
        visorder::detail::read_result(read, 1 << 20);
    } catch (const visorder::InputError&) {
        // No result, and said to be none.
    }
    return 0;
}
