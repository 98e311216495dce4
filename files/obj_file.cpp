#include "files/obj_file.h"

#include "files/printable.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <string_view>

namespace visorder::detail {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

// What polygons look like, how they are grouped, and parameters of curves.
constexpr std::array ignored{"vt",    "vn",       "vp",       "o",          "g",        "s",
                             "mg",    "usemtl",   "mtllib",   "maplib",     "usemap",   "lod",
                             "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

// Curves and surfaces that are no polygons, and what describes them.
constexpr std::array free_form{"curv", "curv2", "surf"};
constexpr std::array free_form_details{"cstype", "deg", "bmat", "step", "parm",  "trim", "hole",
                                       "scrv",   "sp",  "end",  "con",  "ctech", "stech"};

bool is_one_of(std::span<const char* const> words, std::string_view word)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

class ObjParser {
public:
    explicit ObjParser(const std::filesystem::path& path) { grid_.path = path; }

    FileGrid run(std::string_view content)
    {
        constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
        if (content.starts_with(byte_order_mark))
            content.remove_prefix(byte_order_mark.size());
        std::string text;
        while (!content.empty()) {
            ++line_;
            std::string_view line = content.substr(0, content.find('\n'));
            content.remove_prefix(std::min(line.size() + 1, content.size()));
            line = line.substr(0, line.find('#'));
            line = line.substr(0, line.find_last_not_of(blanks) + 1);
            if (line.ends_with('\\')) { // goes on in the next line
                text += line.substr(0, line.size() - 1);
                text += ' ';
                continue;
            }
            parse(text.empty() ? line : text += line);
            text.clear();
        }
        if (!text.empty())
            fail("the file ends within it");
        if (std::all_of(grid_.cells.begin(), grid_.cells.end(),
                        [](const ListedCell& cell) { return cell.shape == ListedShape::lower; }))
            throw InputError(fmt::format("{}: there are no polygons in it", grid_.path.string()));
        if (free_form_ > 0)
            grid_.notes.push_back(fmt::format("{} free-form curves and surfaces left out", free_form_));
        return std::move(grid_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(fmt::format("{}: line {}: {}", grid_.path.string(), line_, what));
    }

    void parse(std::string_view line)
    {
        const std::string_view keyword = next_word(line);
        if (keyword == "v")
            parse_point(line);
        else if (keyword == "f" || keyword == "fo") // fo: what f was once called
            parse_polygon(line);
        else if (keyword == "p" || keyword == "l")
            grid_.add({ListedShape::lower}, {});
        else if (is_one_of(free_form, keyword))
            ++free_form_;
        else if (!keyword.empty() && !is_one_of(ignored, keyword) && !is_one_of(free_form_details, keyword))
            fail(fmt::format("\"{}\" is nothing that a polygon model has", printable(keyword)));
    }

    /// Takes the first word off a line; empty at its end.
    static std::string_view next_word(std::string_view& line)
    {
        line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
        const std::string_view word = line.substr(0, line.find_first_of(blanks));
        line.remove_prefix(word.size());
        return word;
    }

    template <class Number>
    Number number(std::string_view word) const
    {
        Number value{};
        const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
        const char* end = word.data() + word.size();
        if (const auto [stop, error] = std::from_chars(begin, end, value); error != std::errc() || stop != end)
            fail(fmt::format("\"{}\" is not a number that can be taken here", printable(word)));
        return value;
    }

    /// v x y z, followed by nothing, a weight, or a colour.
    void parse_point(std::string_view line)
    {
        std::array<double, 3> p{};
        for (double& coordinate : p) {
            const std::string_view word = next_word(line);
            if (word.empty())
                fail("a point needs three coordinates");
            coordinate = number<double>(word);
            if (!std::isfinite(coordinate))
                fail("a coordinate is not finite");
        }
        grid_.points.emplace_back(p[0], p[1], p[2]);
    }

    void parse_polygon(std::string_view line)
    {
        corners_.clear();
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line))
            corners_.push_back(corner(word));
        if (corners_.size() < 3)
            fail(fmt::format("a polygon of {} corners", corners_.size()));
        grid_.add({ListedShape::polygon}, corners_);
    }

    /// The point of v, v/vt, v//vn or v/vt/vn: counted from 1, or back from the last point so far if negative.
    std::int64_t corner(std::string_view word) const
    {
        const auto index = number<std::int64_t>(word.substr(0, word.find('/')));
        const auto count = static_cast<std::int64_t>(grid_.points.size());
        if (index == 0 || index > count || index < -count)
            fail(fmt::format("there is no point {}, {} came before", index, count));
        return index > 0 ? index - 1 : count + index;
    }

    FileGrid grid_;
    std::size_t line_ = 0;
    std::vector<std::int64_t> corners_;
    std::size_t free_form_ = 0;
};

} // namespace

FileGrid read_obj_file(const std::filesystem::path& path, std::string_view content)
{
    return ObjParser(path).run(content);
}

} // namespace visorder::detail
