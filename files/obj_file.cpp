#include "files/obj_file.h"

#include "files/polygon.h"
#include "files/printable.h"
#include "scene/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <string_view>

namespace visorder {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

// What polygons look like, how they are grouped, and parameters of curves.
constexpr std::array ignored{"vt",    "vn",       "vp",       "o",          "g",        "s",
                             "mg",    "usemtl",   "mtllib",   "maplib",     "usemap",   "lod",
                             "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

class ObjParser {
public:
    explicit ObjParser(const std::filesystem::path& path) : path_(path) {}

    MeshFile run()
    {
        std::ifstream file(path_, std::ios::binary);
        std::string text;
        for (std::string line; std::getline(file, line);) {
            ++line_;
            line.erase(std::min(line.find('#'), line.size()));
            line.erase(line.find_last_not_of(blanks) + 1);
            if (line.ends_with('\\')) { // goes on in the next line
                text += line.substr(0, line.size() - 1) + ' ';
                continue;
            }
            parse(text + line);
            text.clear();
        }
        if (!text.empty())
            fail("the file ends within it");
        if (mesh().cell_count() == 0)
            throw InputError(fmt::format("{}: there are no polygons in it", path_.string()));
        if (split_ > 0)
            result_.notes.push_back(fmt::format("{} polygons split into triangles", split_));
        if (lower_ > 0)
            result_.notes.push_back(fmt::format("{} points and lines left out", lower_));
        return std::move(result_);
    }

private:
    Mesh& mesh() { return result_.mesh; }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(fmt::format("{}: line {}: {}", path_.string(), line_, what));
    }

    void parse(std::string_view line)
    {
        const std::string_view keyword = next_word(line);
        if (keyword == "v")
            parse_point(line);
        else if (keyword == "f" || keyword == "fo") // fo: what f was once called
            parse_polygon(line);
        else if (keyword == "p" || keyword == "l")
            ++lower_;
        else if (!keyword.empty() && std::find(ignored.begin(), ignored.end(), keyword) == ignored.end())
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
        mesh().points.emplace_back(p[0], p[1], p[2]);
    }

    void parse_polygon(std::string_view line)
    {
        corners_.clear();
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line))
            corners_.push_back(corner(word));
        if (corners_.size() < 3)
            fail(fmt::format("a polygon of {} corners", corners_.size()));
        const auto triangles = triangles_of(corners_, mesh().points);
        if (triangles.size() > 1)
            ++split_;
        for (const auto& triangle : triangles)
            mesh().add(CellShape::triangle, triangle);
    }

    /// The point of v, v/vt, v//vn or v/vt/vn: counted from 1, or back from the last point so far if negative.
    PointId corner(std::string_view word) const
    {
        const auto index = number<std::int64_t>(word.substr(0, word.find('/')));
        const auto count = static_cast<std::int64_t>(result_.mesh.points.size());
        if (index == 0 || index > count || index < -count)
            fail(fmt::format("there is no point {}, {} came before", index, count));
        return static_cast<PointId>(index > 0 ? index - 1 : count + index);
    }

    const std::filesystem::path& path_;
    MeshFile result_;
    std::size_t line_ = 0;
    std::vector<PointId> corners_;
    std::size_t split_ = 0;
    std::size_t lower_ = 0;
};

} // namespace

MeshFile read_obj_file(const std::filesystem::path& path, const ReadOptions& options)
{
    if (!options.scalar.empty())
        throw InputError(fmt::format("{}: no scalar \"{}\"; it has: none", path.string(), options.scalar));
    return ObjParser(path).run();
}

} // namespace visorder
