#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace visorder::detail {

/// The bytes of a legacy VTK file, read from front to back as VTK reads them: words between blanks, numbers, lines, and
/// arrays of numbers in text or in binary. Throws InputError, without the file's name, where something else comes.
class LegacyText {
public:
    explicit LegacyText(std::string_view bytes) : rest_(bytes) {}

    std::size_t bytes_left() const { return rest_.size(); }

    /// The rest of the line, which is passed over, its end included.
    std::string_view line();
    /// The next word in small letters, at most 255 characters of it; empty at the end of the file.
    std::string word();
    /// The same, where there must be one; `what` it is, for the message.
    std::string word(const char* what);
    /// The next word, which must be a whole number.
    std::int64_t integer(const char* what);
    /// Such a number that is at least 0.
    std::uint64_t count(const char* what);

    /// Reads as many whole numbers in text as there is room for.
    void read_integers(std::span<std::int64_t> numbers, const std::string& of_what);
    /// Passes over numbers in text: blanks stand between them, or their signs alone.
    void skip_numbers(std::uint64_t count, const std::string& of_what);
    /// Passes over the rest of a line, which VTK takes to be short, and then over bytes.
    std::string_view binary(std::uint64_t bytes, const std::string& of_what);
    /// Passes over strings in binary, each after its length.
    void skip_binary_strings(std::uint64_t count, const std::string& of_what);

private:
    void skip_blanks();
    [[noreturn]] static void fail_short(const std::string& of_what);
    [[noreturn]] static void fail_number(const char* at, const char* end, const std::string& of_what);

    std::string_view rest_;
};

} // namespace visorder::detail
