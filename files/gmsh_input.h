#pragma once

#include "files/byte_scanner.h"
#include "files/text_scanner.h"

#include <bit>

namespace visorder::detail {

/// Reads the numbers of a Gmsh file, whose sections are all in text or all in binary, and finds its sections.
class GmshInput {
public:
    GmshInput(const std::filesystem::path& path, std::string_view content)
        : text_(path, content), bytes_(path, content, false)
    {
    }

    void set_binary(bool swapped)
    {
        binary_ = true;
        bytes_.set_swapped(swapped);
    }
    bool is_binary() const { return binary_; }

    [[noreturn]] void fail(const std::string& what) const
    {
        if (in_bytes_)
            bytes_.fail(what);
        text_.fail(what);
    }

    /// Names, titles and counts of data sections are text in either kind of file.
    TextScanner& text() { return text_; }

    /// What follows up to `end_binary` is in binary, if the file is.
    void begin_binary()
    {
        if (!binary_)
            return;
        text_.rest_of_line();
        bytes_.skip_to(text_.position());
        in_bytes_ = true;
    }
    void end_binary()
    {
        if (in_bytes_)
            text_.skip_to(bytes_.position());
        in_bytes_ = false;
    }

    /// A C int.
    std::int64_t integer() { return in_bytes_ ? bytes_.read<std::int32_t>("a number") : text_.integer("a number"); }
    /// A C size_t.
    std::int64_t size()
    {
        return in_bytes_ ? static_cast<std::int64_t>(bytes_.read<std::uint64_t>("a number"))
                         : text_.integer("a number");
    }
    double real() { return in_bytes_ ? bytes_.read<double>("a number") : text_.real("a number"); }

    /// Checks a count of things that take some numbers each: of `bytes` bytes in binary, or a digit and a blank.
    std::size_t checked_count(std::int64_t count, std::size_t numbers, std::size_t bytes) const
    {
        const std::size_t left = in_bytes_ ? bytes_.remaining() : text_.text().size() - text_.position();
        if (count < 0 || static_cast<std::size_t>(count) > left / (in_bytes_ ? bytes : 2 * numbers) + 1)
            fail("a count of " + std::to_string(count) + " does not fit the rest of the file");
        return static_cast<std::size_t>(count);
    }

    /// Goes on after the word that ends a section.
    void skip_section(const std::string& end)
    {
        const std::size_t found = text_.text().find(end, text_.position());
        if (found == std::string_view::npos)
            text_.fail("there is no " + end);
        text_.skip_to(found + end.size());
    }

private:
    TextScanner text_;
    ByteScanner bytes_;
    bool binary_ = false;
    bool in_bytes_ = false;
};

} // namespace visorder::detail
