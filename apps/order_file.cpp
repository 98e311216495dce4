#include "apps/order_file.h"

#include "apps/output_file.h"
#include "files/input_content.h"
#include "visorder/error.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <iterator>
#include <regex>
#include <string>

namespace visorder::apps {

using namespace detail;

namespace {

static_assert(std::endian::native == std::endian::little, "the array is written as it lies in memory");

// NumPy's format 1.0: magic, version, length of the header, a Python dictionary padded with blanks to a multiple of 64.
constexpr std::string_view magic("\x93NUMPY\x01\x00", 8);

std::string npy_of(std::span<const std::uint64_t> cells)
{
    const bool narrow = std::all_of(cells.begin(), cells.end(), [](std::uint64_t cell) { return cell <= 0xffffffffu; });
    std::string header =
        fmt::format("{{'descr': '<u{}', 'fortran_order': False, 'shape': ({},), }}", narrow ? 4 : 8, cells.size());
    const std::size_t prefix = magic.size() + 2;
    header.append(63 - (prefix + header.size()) % 64, ' ');
    header += '\n';
    const auto length = static_cast<std::uint16_t>(header.size());
    std::string bytes(magic);
    bytes.append(reinterpret_cast<const char*>(&length), 2);
    bytes += header;
    if (narrow) {
        const std::vector<std::uint32_t> words(cells.begin(), cells.end());
        bytes.append(reinterpret_cast<const char*>(words.data()), 4 * words.size());
    } else {
        bytes.append(reinterpret_cast<const char*>(cells.data()), cells.size_bytes());
    }
    return bytes;
}

std::string text_of(std::span<const std::uint64_t> cells)
{
    fmt::memory_buffer text;
    for (std::uint64_t cell : cells)
        fmt::format_to(std::back_inserter(text), "{}\n", cell);
    return fmt::to_string(text);
}

[[noreturn]] void bad(const std::filesystem::path& file, const std::string& what)
{
    throw InputError(fmt::format("{}: {}", file.string(), what));
}

std::vector<std::uint64_t> cells_of_npy(const std::filesystem::path& file, const std::string& bytes)
{
    if (bytes.size() < 10 || bytes.compare(0, 6, magic.substr(0, 6)) != 0)
        bad(file, "not a NumPy array");
    const bool first_version = bytes[6] == 1;
    const std::size_t prefix = first_version ? 10 : 12;
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 8, std::min<std::size_t>(first_version ? 2 : 4, bytes.size() - 8));
    if (bytes.size() < prefix + length)
        bad(file, "truncated");
    constexpr std::uint32_t longest_header = 4096; // std::regex takes stack for each character
    if (length > longest_header)
        bad(file, fmt::format("a header of {} bytes is not that of a list", length));
    const std::string header = bytes.substr(prefix, length);
    std::smatch match;
    if (!std::regex_search(header, match, std::regex("'descr': *'([<>|=])([iu])([1248])'")))
        bad(file, "not an array of integers");
    const bool swap = match[1] == ">";
    const bool is_signed = match[2] == "i";
    const auto width = static_cast<std::size_t>(match[3].str()[0] - '0');
    if (!std::regex_search(header, match, std::regex("'shape': *\\(([0-9]+), *\\)")))
        bad(file, "not an array of one dimension");
    const std::string digits = match[1];
    std::size_t count = 0;
    const std::errc error = std::from_chars(digits.data(), digits.data() + digits.size(), count).ec;
    const std::size_t data_bytes = bytes.size() - prefix - length;
    if (error != std::errc() || count > data_bytes / width || count * width != data_bytes)
        bad(file, "its length is not that of its shape");
    std::vector<std::uint64_t> cells(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint64_t value = 0;
        for (std::size_t k = 0; k < width; ++k) {
            const char byte = bytes[prefix + length + i * width + (swap ? k : width - 1 - k)];
            value = value << 8 | static_cast<unsigned char>(byte);
        }
        const bool negative = is_signed && (value >> (8 * width - 1)) != 0;
        if (negative)
            bad(file, fmt::format("entry {} is no cell", i));
        cells[i] = value;
    }
    return cells;
}

std::vector<std::uint64_t> cells_of_text(const std::filesystem::path& file, const std::string& text)
{
    std::vector<std::uint64_t> cells;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t line = 1; at < end; ++line) {
        std::uint64_t cell = 0;
        const auto [next, error] = std::from_chars(at, end, cell);
        const char* after = next < end && *next == '\r' ? next + 1 : next;
        if (error != std::errc() || (after < end && *after != '\n'))
            bad(file, fmt::format("line {} is not the number of a cell", line));
        cells.push_back(cell);
        at = after + 1;
    }
    return cells;
}

} // namespace

void write_order(const std::filesystem::path& file, std::span<const std::uint64_t> cells)
{
    write_file(file, small_ending(file) == ".npy" ? npy_of(cells) : text_of(cells));
}

std::vector<std::uint64_t> read_order(const std::filesystem::path& file)
{
    constexpr std::uint64_t most_bytes = std::uint64_t{8} << 30; // of text, for all cells that a mesh can have
    std::string bytes;
    try {
        bytes = input_content(file, most_bytes);
    } catch (const InputError& error) {
        bad(file, error.what());
    }
    return small_ending(file) == ".npy" ? cells_of_npy(file, bytes) : cells_of_text(file, bytes);
}

} // namespace visorder::apps
