#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace visorder::detail {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type;
    bool is_list = false;
    PlyType count_type = PlyType::uint8; ///< of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

/// What a PLY file says of its content.
struct PlyHeader {
    enum class Encoding : std::uint8_t { text, little_endian, big_endian };
    Encoding encoding = Encoding::text;
    std::vector<PlyElement> elements;
    std::size_t end = 0; ///< the byte at which the content begins
};

/// Throws InputError, naming the file and the line.
PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view content);

} // namespace visorder::detail
