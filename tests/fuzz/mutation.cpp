#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <random>

namespace visorder::tests {

namespace {

class Mutation {
public:
    explicit Mutation(std::uint64_t number) : random_(number) {}

    std::string run(const std::vector<std::string>& contents)
    {
        std::string content = contents[below(contents.size())];
        for (std::size_t changes = 1 + below(4); changes > 0 && !content.empty(); --changes)
            change(content, contents[below(contents.size())]);
        return content;
    }

private:
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

    void change(std::string& content, const std::string& other)
    {
        const std::size_t at = below(content.size());
        const std::size_t length = std::min(content.size() - at, 1 + below(std::size_t{1} << below(9)));
        switch (below(10)) {
        case 0:
            content[at] ^= static_cast<char>(1u << below(8));
            break;
        case 1:
            content[at] = static_cast<char>(below(256));
            break;
        case 2:
            content.resize(at);
            break;
        case 3:
            content.erase(at, length);
            break;
        case 4:
            content.insert(below(content.size()), content.substr(at, length));
            break;
        case 5:
            set_integer(content, at);
            break;
        case 6:
        case 7:
            replace_number(content, at);
            break;
        case 8:
            swap_words(content, at);
            break;
        default:
            if (!other.empty())
                content.replace(at, length, other.substr(below(other.size()), length));
        }
    }

    /// Writes a whole number of 1 to 8 bytes, of either byte order, that often goes wrong.
    void set_integer(std::string& content, std::size_t at)
    {
        constexpr std::array<std::uint64_t, 10> values{
            0, 1, 255, 0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000000, 0x7fffffffffffffff};
        const std::uint64_t value = values[below(values.size())];
        const std::size_t bytes = std::size_t{1} << below(4);
        const bool big_endian = below(2) == 0;
        for (std::size_t i = 0; i < bytes && at + i < content.size(); ++i)
            content[at + i] = static_cast<char>(value >> 8 * (big_endian ? bytes - 1 - i : i));
    }

    /// Replaces the next number in text.
    void replace_number(std::string& content, std::size_t at)
    {
        constexpr std::string_view digits = "0123456789";
        const std::size_t begin = content.find_first_of(digits, at);
        if (begin == std::string::npos)
            return;
        const std::size_t end = std::min(content.find_first_not_of(digits, begin), content.size());
        constexpr std::array<const char*, 14> values{"0",
                                                     "1",
                                                     "2",
                                                     "-1",
                                                     "3",
                                                     "42",
                                                     "13",
                                                     "255",
                                                     "65536",
                                                     "2147483647",
                                                     "2147483648",
                                                     "1000000000",
                                                     "9223372036854775807",
                                                     "nan"};
        content.replace(begin, end - begin, values[below(values.size())]);
    }

    /// Exchanges the next word with another one.
    void swap_words(std::string& content, std::size_t at)
    {
        constexpr std::string_view blanks = " \n\"<>=";
        const auto word = [&](std::size_t from) {
            const std::size_t begin = std::min(content.find_first_not_of(blanks, from), content.size());
            const std::size_t end = std::min(content.find_first_of(blanks, begin), content.size());
            return std::pair(begin, end - begin);
        };
        const auto [a, a_length] = word(at);
        const auto [b, b_length] = word(below(content.size()));
        const std::string of_b = content.substr(b, b_length);
        if (a + a_length <= b) {
            content.replace(b, b_length, content.substr(a, a_length));
            content.replace(a, a_length, of_b);
        } else {
            content.replace(a, a_length, of_b);
        }
    }

    std::mt19937_64 random_;
};

} // namespace

std::string mutated(const std::vector<std::string>& contents, std::uint64_t number)
{
    return Mutation(number).run(contents);
}

} // namespace visorder::tests
