#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace visorder::detail {

/// Reads a text file word by word or line by line, and knows at which line it is. Words are what stands between blanks;
/// lines end in LF, CR LF or CR. A UTF-8 byte order mark at the beginning is passed over. What begins with the comment
/// character is passed over up to the end of its line. All that fails throws InputError, naming file and line.
class TextScanner {
public:
    static constexpr char no_comments = '\0';

    /// The text has to outlive the scanner.
    TextScanner(const std::filesystem::path& path, std::string_view text, char comment = no_comments);

    [[noreturn]] void fail(const std::string& what) const;

    /// The next word, on whatever line; empty at the end of the text.
    std::string_view word();
    /// The next word, which has to be there: `what` names it in the message.
    std::string_view word(const char* what);
    /// The next word of this line; empty at its end.
    std::string_view word_on_line();
    /// What is left of this line, without blanks at its ends; the scanner goes on with the next line.
    std::string_view rest_of_line();
    /// Whether nothing but blanks and comments is left on this line.
    bool at_end_of_line();
    /// Whether nothing but blanks and comments is left.
    bool at_end();

    /// The next word as a number. Exponents may be written with D, as Fortran does.
    double real(const char* what);
    std::int64_t integer(const char* what);
    /// How many things follow: no less than 0, and no more than the text has room for if each takes some bytes.
    std::size_t count(const char* what, std::size_t least_bytes_each = 2);

    /// A word of this text as a number.
    double real_of(std::string_view word) const;
    std::int64_t integer_of(std::string_view word) const;

    std::size_t line() const { return line_; }
    /// Where in the text the scanner stands, in bytes.
    std::size_t position() const { return at_; }
    /// Goes on at a later byte of the text.
    void skip_to(std::size_t position);
    std::string_view text() const { return text_; }

private:
    void skip_blanks(bool over_lines);

    const std::filesystem::path& path_;
    std::string_view text_;
    char comment_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

} // namespace visorder::detail
