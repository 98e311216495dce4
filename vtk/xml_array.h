#pragma once

#include "vtk/xml_tree.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace visorder::detail {

/// What all arrays of a VTK XML file have in common.
struct XmlEncoding {
    bool big_endian = false;
    std::size_t header_bytes = 4;   ///< of a number before data in binary
    std::string compressor;         ///< VTK's name of it; "" for none
    bool appended_is_base64 = true; ///< or as it is

    static XmlEncoding of(const XmlTree& tree);
};

/// The values of an array, as they lie in the file. Throws InputError, without the file's name, where they cannot.
class XmlArray {
public:
    XmlArray(std::string_view content, const XmlTree& tree, const XmlEncoding& encoding, const XmlElement& element);

    std::string name() const;
    /// Bytes of one value; 0 for types that VTK does not know, and for strings and bits.
    std::size_t value_bytes() const { return value_bytes_; }

    /// No more values than that can be read from it.
    std::uint64_t most_values() const { return most_values_; }
    /// The values of an array of whole numbers.
    std::vector<std::int64_t> integers() const;

private:
    void look_at_binary();
    void look_at_blocks(std::string_view data);
    std::string bytes(std::string_view data, std::uint64_t first, std::uint64_t count) const;
    std::uint64_t header_number(std::string_view raw, std::size_t index) const;
    std::string uncompressed() const;
    [[noreturn]] void fail(const std::string& what) const;

    const XmlElement& element_;
    const XmlEncoding& encoding_;
    bool is_text_ = false;
    bool is_base64_ = false;
    std::size_t value_bytes_ = 0;
    bool is_signed_ = false;
    std::string_view data_; // from where the array begins
    std::uint64_t most_values_ = 0;

    // Of compressed data:
    std::uint64_t blocks_ = 0;
    std::uint64_t block_bytes_ = 0; // uncompressed
    std::uint64_t last_block_bytes_ = 0;
    std::vector<std::uint64_t> compressed_bytes_; // of each block
    std::string_view compressed_;                 // all blocks
};

} // namespace visorder::detail
