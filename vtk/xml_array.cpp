// How VTK's XML formats store arrays: VTK User's Guide, "XML File Formats"; vtkXMLDataParser.

#include "vtk/xml_array.h"

#include "files/printable.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <limits>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

namespace visorder::detail {

namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";
constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b)
{
    std::uint64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? UINT64_MAX : product;
}

/// How many bytes base64 digits stand for, up to the first character that is none of theirs.
std::uint64_t decoded_size(std::string_view text)
{
    constexpr std::string_view all = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=";
    return std::min(text.find_first_not_of(all), text.size()) / 4 * 3;
}

/// Characters that `bytes` take in base64.
std::uint64_t encoded_size(std::uint64_t bytes)
{
    return (bytes + 2) / 3 * 4;
}

/// How much smaller a compressor makes data at most.
std::uint64_t most_ratio(const std::string& compressor)
{
    if (compressor == "vtkZLibDataCompressor")
        return 1100; // 1032, by the format
    if (compressor == "vtkLZ4DataCompressor")
        return 256; // 255, by the format
    return 20'000;  // LZMA names no limit; zeros come to 7,000
}

std::size_t bytes_of_type(const std::string& type)
{
    constexpr std::array<std::pair<std::string_view, std::size_t>, 10> types{{{"Int8", 1},
                                                                              {"UInt8", 1},
                                                                              {"Int16", 2},
                                                                              {"UInt16", 2},
                                                                              {"Int32", 4},
                                                                              {"UInt32", 4},
                                                                              {"Int64", 8},
                                                                              {"UInt64", 8},
                                                                              {"Float32", 4},
                                                                              {"Float64", 8}}};
    const auto* const found = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.first == type; });
    return found == types.end() ? 0 : found->second;
}

} // namespace

XmlEncoding XmlEncoding::of(const XmlTree& tree)
{
    XmlEncoding encoding;
    encoding.big_endian = tree.root.attribute("byte_order") == "BigEndian";
    encoding.header_bytes = tree.root.attribute("header_type") == "UInt64" ? 8 : 4;
    encoding.compressor = tree.root.attribute("compressor");
    for (const XmlElement& child : tree.root.children)
        if (child.name == "AppendedData")
            encoding.appended_is_base64 = child.attribute("encoding") != "raw";
    return encoding;
}

XmlArray::XmlArray(std::string_view content, const XmlTree& tree, const XmlEncoding& encoding,
                   const XmlElement& element)
    : element_(element),
      encoding_(encoding),
      value_bytes_(bytes_of_type(element.attribute("type"))),
      is_signed_(element.attribute("type").starts_with("Int"))
{
    const std::string& format = element.attribute("format");
    is_text_ = format == "ascii";
    if (format == "appended") {
        const auto offset = element.number("offset");
        if (tree.appended == 0)
            fail("is appended, but there is no appended data");
        if (!offset || *offset < 0 || static_cast<std::uint64_t>(*offset) > content.size() - tree.appended)
            fail(fmt::format("begins at {} of {} bytes of appended data", offset.value_or(-1),
                             content.size() - tree.appended));
        data_ = content.substr(tree.appended + static_cast<std::size_t>(*offset));
        is_base64_ = encoding.appended_is_base64;
    } else {
        data_ = content.substr(std::min(content.find('>', element.position), content.size() - 1) + 1);
        data_.remove_prefix(std::min(data_.find_first_not_of(blanks), data_.size()));
        data_ = data_.substr(0, data_.find('<'));
        is_base64_ = true;
    }
    if (is_text_)
        most_values_ = (data_.size() + 1) / 2;
    else
        look_at_binary();
}

std::string XmlArray::name() const
{
    const std::string& name = element_.attribute("Name");
    return name.empty() ? "an array without a name" : fmt::format("array \"{}\"", printable(name));
}

void XmlArray::fail(const std::string& what) const
{
    throw InputError(fmt::format("{} {}", name(), what));
}

/// `count` decoded bytes of data, from `first` on, fewer where it ends.
std::string XmlArray::bytes(std::string_view data, std::uint64_t first, std::uint64_t count) const
{
    if (!is_base64_)
        return std::string(data.substr(std::min<std::uint64_t>(first, data.size()), count));
    const std::uint64_t group = first / 3;
    data.remove_prefix(std::min<std::uint64_t>(4 * group, data.size()));
    const std::uint64_t skipped = first - 3 * group;
    data = data.substr(0, std::min<std::uint64_t>(saturating_product(4, (skipped + count + 2) / 3), data.size()));

    std::string decoded;
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : data) {
        const std::size_t digit = base64_digits.find(c);
        if (digit == std::string_view::npos)
            break;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        held += 6;
        if (held >= 8) {
            held -= 8;
            decoded += static_cast<char>(bits >> held & 0xff);
        }
    }
    return decoded.size() <= skipped ? std::string() : decoded.substr(skipped, count);
}

std::uint64_t XmlArray::header_number(std::string_view raw, std::size_t index) const
{
    const std::size_t size = encoding_.header_bytes;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | static_cast<unsigned char>(raw[index * size + (encoding_.big_endian ? i : size - 1 - i)]);
    return value;
}

void XmlArray::look_at_binary()
{
    const std::size_t header = encoding_.header_bytes;
    const std::size_t numbers = encoding_.compressor.empty() ? 1 : 3;
    const std::string first = bytes(data_, 0, numbers * header);
    if (first.size() < numbers * header)
        fail("is cut short");
    if (!encoding_.compressor.empty()) {
        blocks_ = header_number(first, 0);
        block_bytes_ = header_number(first, 1);
        last_block_bytes_ = header_number(first, 2);
        look_at_blocks(data_);
        return;
    }
    const std::uint64_t available = (is_base64_ ? decoded_size(data_) : data_.size()) - header;
    const std::uint64_t size = header_number(first, 0);
    if (size > available)
        fail(fmt::format("says to have {} bytes, but {} are left in the file", size, available));
    most_values_ = value_bytes_ > 0 ? size / value_bytes_ : saturating_product(size, 8);
}

void XmlArray::look_at_blocks(std::string_view data)
{
    const std::size_t header = encoding_.header_bytes;
    if (blocks_ > data.size() / header)
        fail(fmt::format("says to have {} blocks, but {} bytes are left in the file", blocks_, data.size()));
    const std::uint64_t header_size = (3 + blocks_) * header;
    const std::string sizes = bytes(data, 3 * header, blocks_ * header);
    if (sizes.size() < blocks_ * header)
        fail("is cut short");
    data.remove_prefix(std::min<std::uint64_t>(is_base64_ ? encoded_size(header_size) : header_size, data.size()));
    const std::uint64_t available = is_base64_ ? decoded_size(data) : data.size();
    std::uint64_t compressed = 0;
    for (std::uint64_t i = 0; i < blocks_; ++i) {
        compressed_bytes_.push_back(header_number(sizes, i));
        if (compressed_bytes_.back() > available - compressed)
            fail(fmt::format("says to have more compressed bytes than the {} that are left in the file", available));
        compressed += compressed_bytes_.back();
        const std::uint64_t size = last_block_bytes_ > 0 && i + 1 == blocks_ ? last_block_bytes_ : block_bytes_;
        if (size > saturating_product(compressed_bytes_.back() + 64, most_ratio(encoding_.compressor)))
            fail(fmt::format("says that {} compressed bytes come to {}", compressed_bytes_.back(), size));
    }
    if (blocks_ > 0 && (block_bytes_ == 0 || last_block_bytes_ > block_bytes_))
        fail(fmt::format("has blocks of {} bytes, the last of {}", block_bytes_, last_block_bytes_));
    std::uint64_t total = saturating_product(blocks_, block_bytes_);
    if (blocks_ > 0 && last_block_bytes_ > 0)
        total -= block_bytes_ - last_block_bytes_;
    if (total > std::numeric_limits<std::int64_t>::max())
        fail(fmt::format("says to have {} bytes", total));
    compressed_ = data;
    most_values_ = value_bytes_ > 0 ? total / value_bytes_ : saturating_product(total, 8);
}

std::string XmlArray::uncompressed() const
{
    vtkSmartPointer<vtkDataCompressor> compressor;
    if (encoding_.compressor == "vtkZLibDataCompressor")
        compressor = vtkSmartPointer<vtkZLibDataCompressor>::New();
    else if (encoding_.compressor == "vtkLZ4DataCompressor")
        compressor = vtkSmartPointer<vtkLZ4DataCompressor>::New();
    else if (encoding_.compressor == "vtkLZMADataCompressor")
        compressor = vtkSmartPointer<vtkLZMADataCompressor>::New();
    else
        fail(fmt::format("is compressed by {}", printable(encoding_.compressor)));
    std::string all;
    std::uint64_t at = 0;
    for (std::uint64_t i = 0; i < blocks_; ++i) {
        const std::string block = bytes(compressed_, at, compressed_bytes_[i]);
        at += compressed_bytes_[i];
        std::string plain(last_block_bytes_ > 0 && i + 1 == blocks_ ? last_block_bytes_ : block_bytes_, '\0');
        if (block.size() < compressed_bytes_[i] ||
            compressor->Uncompress(reinterpret_cast<const unsigned char*>(block.data()), block.size(),
                                   reinterpret_cast<unsigned char*>(plain.data()), plain.size()) != plain.size())
            fail("cannot be uncompressed");
        all += plain;
    }
    return all;
}

std::vector<std::int64_t> XmlArray::integers() const
{
    std::vector<std::int64_t> values;
    if (is_text_) {
        const char* at = data_.data();
        const char* const end = at + data_.size();
        while (true) {
            while (at < end && blanks.find(*at) != std::string_view::npos)
                ++at;
            std::int64_t value = 0;
            const auto [stop, error] = std::from_chars(at, end, value);
            if (error != std::errc())
                return values;
            values.push_back(value);
            at = stop;
        }
    }
    if (value_bytes_ == 0)
        fail("is not of whole numbers");
    const std::string raw = encoding_.compressor.empty()
                                ? bytes(data_, encoding_.header_bytes, most_values_ * value_bytes_)
                                : uncompressed();
    values.resize(raw.size() / value_bytes_);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(raw[i * value_bytes_ + k]); };
        std::uint64_t value =
            is_signed_ && byte(encoding_.big_endian ? 0 : value_bytes_ - 1) >= 128 ? ~std::uint64_t{0} : 0;
        for (std::size_t k = 0; k < value_bytes_; ++k)
            value = value << 8 | byte(encoding_.big_endian ? k : value_bytes_ - 1 - k);
        values[i] = static_cast<std::int64_t>(value);
    }
    return values;
}

} // namespace visorder::detail
