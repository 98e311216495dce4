#include "files/text_scanner.h"

#include "files/printable.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <limits>

namespace visorder::detail {

namespace {

bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

} // namespace

TextScanner::TextScanner(const std::filesystem::path& path, std::string_view text, char comment)
    : path_(path), text_(text), comment_(comment)
{
    if (text_.starts_with("\xef\xbb\xbf"))
        at_ = 3;
}

void TextScanner::fail(const std::string& what) const
{
    throw InputError(fmt::format("{}: line {}: {}", path_.string(), line_, what));
}

void TextScanner::skip_blanks(bool over_lines)
{
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (comment_ != no_comments && c == comment_) {
            while (at_ < text_.size() && !is_line_end(text_[at_]))
                ++at_;
        } else if (is_line_end(c) && over_lines) {
            at_ += c == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
            ++line_;
        } else if (is_blank(c)) {
            ++at_;
        } else {
            return;
        }
    }
}

std::string_view TextScanner::word()
{
    skip_blanks(true);
    return word_on_line();
}

std::string_view TextScanner::word(const char* what)
{
    const std::string_view found = word();
    if (found.empty())
        fail(fmt::format("the file ends where {} should be", what));
    return found;
}

std::string_view TextScanner::word_on_line()
{
    skip_blanks(false);
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && !is_line_end(text_[at_]) &&
           (comment_ == no_comments || text_[at_] != comment_))
        ++at_;
    return text_.substr(begin, at_ - begin);
}

std::string_view TextScanner::rest_of_line()
{
    while (at_ < text_.size() && is_blank(text_[at_]))
        ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_line_end(text_[at_]))
        ++at_;
    std::string_view rest = text_.substr(begin, at_ - begin);
    while (!rest.empty() && is_blank(rest.back()))
        rest.remove_suffix(1);
    if (at_ < text_.size()) {
        at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
        ++line_;
    }
    return rest;
}

bool TextScanner::at_end_of_line()
{
    skip_blanks(false);
    return at_ == text_.size() || is_line_end(text_[at_]);
}

bool TextScanner::at_end()
{
    skip_blanks(true);
    return at_ == text_.size();
}

double TextScanner::real(const char* what)
{
    return real_of(word(what));
}

std::int64_t TextScanner::integer(const char* what)
{
    return integer_of(word(what));
}

std::size_t TextScanner::count(const char* what, std::size_t least_bytes_each)
{
    const std::int64_t value = integer(what);
    if (value < 0)
        fail(fmt::format("{} is {}", what, value));
    if (static_cast<std::size_t>(value) > (text_.size() - at_) / least_bytes_each + 1)
        fail(fmt::format("{} is {}, more than the rest of the file has room for", what, value));
    return static_cast<std::size_t>(value);
}

double TextScanner::real_of(std::string_view word) const
{
    double value = 0;
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* end = word.data() + word.size();
    auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc() && stop == end)
        return value;
    if (error == std::errc::result_out_of_range && stop == end) // below the least number, or beyond the greatest
        return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos
                   ? 0.0
                   : (word.starts_with('-') ? -1 : 1) * std::numeric_limits<double>::infinity();
    if (error == std::errc() && (*stop == 'd' || *stop == 'D')) {
        std::array<char, 64> with_e{};
        if (static_cast<std::size_t>(end - begin) < with_e.size()) {
            std::copy(begin, end, with_e.begin());
            with_e[static_cast<std::size_t>(stop - begin)] = 'e';
            const char* e_end = with_e.data() + (end - begin);
            if (const auto again = std::from_chars(with_e.data(), e_end, value);
                again.ec == std::errc() && again.ptr == e_end)
                return value;
        }
    }
    fail(fmt::format("\"{}\" is not a number that can be taken here", printable(word)));
}

std::int64_t TextScanner::integer_of(std::string_view word) const
{
    std::int64_t value = 0;
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* end = word.data() + word.size();
    if (const auto [stop, error] = std::from_chars(begin, end, value); error != std::errc() || stop != end)
        fail(fmt::format("\"{}\" is not a number that can be taken here", printable(word)));
    return value;
}

void TextScanner::skip_to(std::size_t position)
{
    for (; at_ < position && at_ < text_.size(); ++at_)
        if (text_[at_] == '\n')
            ++line_;
}

} // namespace visorder::detail
