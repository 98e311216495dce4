#pragma once

#include "tests/temporary_folder.h"

#include <cstddef>
#include <cstdint>
#include <fstream>

namespace visorder::tests {

/// A file for readers that take no bytes in memory, which holds one input after the other.
inline std::filesystem::path fuzzed_file(const char* name, const std::uint8_t* data, std::size_t size)
{
    static const TemporaryFolder folder;
    const std::filesystem::path path = folder.file(name);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path;
}

} // namespace visorder::tests
