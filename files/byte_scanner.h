#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

namespace visorder::detail {

/// Reads numbers off a binary file, of either byte order. All that fails throws InputError, naming file and byte.
class ByteScanner {
public:
    /// The bytes have to outlive the scanner. `swapped`: numbers are of the other byte order than this machine's.
    ByteScanner(const std::filesystem::path& path, std::string_view bytes, bool swapped)
        : path_(path), bytes_(bytes), swapped_(swapped)
    {
    }

    [[noreturn]] void fail(const std::string& what) const;

    template <class T>
    T read(const char* what)
    {
        std::array<char, sizeof(T)> raw{};
        const std::string_view bytes = take(sizeof(T), what);
        std::memcpy(raw.data(), bytes.data(), sizeof(T));
        if (swapped_)
            std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }

    /// The next bytes as they are.
    std::string_view take(std::size_t count, const char* what)
    {
        if (count > remaining())
            fail(std::string("the file ends within ") + what);
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }

    /// Checks that there is room for so many things that take so many bytes each.
    void expect_room(std::uint64_t count, std::size_t bytes_each, const char* what) const;

    std::size_t remaining() const { return bytes_.size() - at_; }
    std::size_t position() const { return at_; }
    void skip_to(std::size_t position) { at_ = std::min(position, bytes_.size()); }
    void set_swapped(bool swapped) { swapped_ = swapped; }

private:
    const std::filesystem::path& path_;
    std::string_view bytes_;
    bool swapped_;
    std::size_t at_ = 0;
};

} // namespace visorder::detail
