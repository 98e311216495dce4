#include "vtk/legacy_text.h"

#include "files/printable.h"
#include "visorder/error.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

// Characters as VTK's streams see them in the C locale.
bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool is_sign(char c)
{
    return c == '+' || c == '-';
}

/// Where the number ends that begins at `at`; null for what is no number.
const char* end_of_number(const char* at, const char* end)
{
    if (at < end && is_sign(*at))
        ++at;
    bool digits = false;
    const auto skip_digits = [&] {
        for (; at < end && is_digit(*at); ++at)
            digits = true;
    };
    skip_digits();
    if (at < end && *at == '.') {
        ++at;
        skip_digits();
    }
    if (!digits)
        return nullptr;
    if (at < end && (*at == 'e' || *at == 'E')) {
        ++at;
        if (at < end && is_sign(*at))
            ++at;
        digits = false;
        skip_digits();
        if (!digits)
            return nullptr;
    }
    return at;
}

} // namespace

void LegacyText::fail_short(const std::string& of_what)
{
    throw InputError(fmt::format("the file ends within {}", of_what));
}

void LegacyText::fail_number(const char* at, const char* end, const std::string& of_what)
{
    const char* const word_end = std::find_if(at, end, is_blank);
    throw InputError(fmt::format("\"{}\" in {} is not a number that can be taken there",
                                 printable({at, static_cast<std::size_t>(word_end - at)}), of_what));
}

void LegacyText::skip_blanks()
{
    const auto* const first = std::find_if_not(rest_.begin(), rest_.end(), is_blank);
    rest_.remove_prefix(static_cast<std::size_t>(first - rest_.begin()));
}

std::string_view LegacyText::line()
{
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view result = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return result;
}

std::string LegacyText::word()
{
    skip_blanks();
    constexpr std::size_t longest = 255;
    const auto* const end = std::find_if(rest_.begin(), rest_.end(), is_blank);
    std::string result(rest_.substr(0, std::min(longest, static_cast<std::size_t>(end - rest_.begin()))));
    rest_.remove_prefix(result.size());
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return result;
}

std::string LegacyText::word(const char* what)
{
    std::string result = word();
    if (result.empty())
        throw InputError(fmt::format("the file ends before {}", what));
    return result;
}

std::int64_t LegacyText::integer(const char* what)
{
    const std::string text = word(what);
    std::int64_t value = 0;
    const char* const begin = text.data() + (text[0] == '+' ? 1 : 0);
    const char* const end = text.data() + text.size();
    if (const auto [stop, error] = std::from_chars(begin, end, value); error != std::errc() || stop != end)
        throw InputError(fmt::format("\"{}\" is not {}", printable(text), what));
    return value;
}

std::uint64_t LegacyText::count(const char* what)
{
    const std::int64_t value = integer(what);
    if (value < 0)
        throw InputError(fmt::format("{} is not {}", value, what));
    return static_cast<std::uint64_t>(value);
}

void LegacyText::read_integers(std::span<std::int64_t> numbers, const std::string& of_what)
{
    const char* at = rest_.data();
    const char* const end = at + rest_.size();
    for (std::int64_t& number : numbers) {
        at = std::find_if_not(at, end, is_blank);
        if (at == end)
            fail_short(of_what);
        const char* const digits = at + (*at == '+' ? 1 : 0);
        const auto [stop, error] = std::from_chars(digits, end, number);
        if (error != std::errc() || (stop < end && !is_blank(*stop) && !is_sign(*stop)))
            fail_number(at, end, of_what);
        at = stop;
    }
    rest_.remove_prefix(static_cast<std::size_t>(at - rest_.data()));
}

void LegacyText::skip_numbers(std::uint64_t count, const std::string& of_what)
{
    if (count > rest_.size()) // each takes bytes
        fail_short(of_what);
    const char* at = rest_.data();
    const char* const end = at + rest_.size();
    for (; count > 0; --count) {
        at = std::find_if_not(at, end, is_blank);
        if (at == end)
            fail_short(of_what);
        const char* const stop = end_of_number(at, end);
        if (!stop || (stop < end && !is_blank(*stop) && !is_sign(*stop)))
            fail_number(at, end, of_what);
        at = stop;
    }
    rest_.remove_prefix(static_cast<std::size_t>(at - rest_.data()));
}

std::string_view LegacyText::binary(std::uint64_t bytes, const std::string& of_what)
{
    constexpr std::size_t longest = 254;
    if (line().size() > longest)
        throw InputError(fmt::format("there is no end of the line before {}", of_what));
    if (bytes > rest_.size())
        throw InputError(fmt::format("{} take {} bytes, but {} are left in the file", of_what, bytes, rest_.size()));
    const std::string_view result = rest_.substr(0, bytes);
    rest_.remove_prefix(bytes);
    return result;
}

void LegacyText::skip_binary_strings(std::uint64_t count, const std::string& of_what)
{
    binary(0, of_what);
    if (count > rest_.size())
        fail_short(of_what);
    for (; count > 0; --count) {
        // The first two bits of the length tell how many bytes it has: 8, 4, 2 or 1.
        const std::size_t length_bytes = rest_.empty() ? 1 : 8u >> (static_cast<unsigned char>(rest_[0]) >> 6);
        if (length_bytes > rest_.size())
            fail_short(of_what);
        std::uint64_t length = 0;
        for (std::size_t i = 0; i < length_bytes; ++i)
            length = length << 8 | static_cast<unsigned char>(rest_[i]);
        if (length_bytes < 8)
            length &= (std::uint64_t{1} << (8 * length_bytes - 2)) - 1;
        rest_.remove_prefix(length_bytes);
        if (length > rest_.size())
            fail_short(of_what);
        rest_.remove_prefix(length);
    }
}

} // namespace visorder::detail
