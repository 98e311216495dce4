#include "vtk/legacy_check.h"

#include "files/mapped_file.h"
#include "files/printable.h"
#include "visorder/error.h"
#include "vtk/legacy_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>
#include <vtkCellType.h>

namespace visorder::detail {

namespace {

constexpr std::uint64_t most_components = 100'000;
constexpr int most_turns = 100; // from POINT_DATA to CELL_DATA and back, each of which takes room on VTK's stack

/// How an array's values lie in a binary file; nothing for a word that VTK does not know. VTK compares beginnings.
struct ValueType {
    enum class Kind { integer, real, bit, string, variant };
    Kind kind;
    std::size_t bytes; ///< of one value, for numbers
};

std::optional<ValueType> value_type(std::string_view word)
{
    using Kind = ValueType::Kind;
    struct Known {
        std::string_view beginning;
        ValueType type;
    };
    constexpr std::array known{Known{"bit", {Kind::bit, 0}},
                               Known{"unsigned_char", {Kind::integer, 1}},
                               Known{"short", {Kind::integer, 2}},
                               Known{"unsigned_short", {Kind::integer, 2}},
                               Known{"vtkidtype", {Kind::integer, 4}},
                               Known{"int", {Kind::integer, 4}},
                               Known{"unsigned_int", {Kind::integer, 4}},
                               Known{"long", {Kind::integer, 8}},
                               Known{"unsigned_long", {Kind::integer, 8}},
                               Known{"vtktypeint64", {Kind::integer, 8}},
                               Known{"vtktypeuint64", {Kind::integer, 8}},
                               Known{"float", {Kind::real, 4}},
                               Known{"double", {Kind::real, 8}},
                               Known{"string", {Kind::string, 0}},
                               Known{"utf8_string", {Kind::string, 0}},
                               Known{"variant", {Kind::variant, 0}}};
    if (word == "char" || word == "signed_char")
        return ValueType{Kind::integer, 1};
    const auto* const found =
        std::find_if(known.begin(), known.end(), [&](const Known& k) { return word.starts_with(k.beginning); });
    return found == known.end() ? std::nullopt : std::optional(found->type);
}

std::string in_capitals(std::string_view keyword)
{
    std::string text = printable(keyword);
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    return text;
}

std::int64_t big_endian(const char* bytes, std::size_t size)
{
    std::uint64_t value = static_cast<unsigned char>(bytes[0]) < 128 ? 0 : ~std::uint64_t{0};
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return static_cast<std::int64_t>(value);
}

/// The cells of a list, one after the other: how many numbers, and those.
struct CellList {
    std::vector<std::size_t> begins{0}; // one more than cells
    std::vector<std::int64_t> numbers;

    std::size_t size() const { return begins.size() - 1; }
};

/// Of "5.1", 5. VTK takes a version for 0 that it cannot read to its end.
int major_version(std::string_view text)
{
    int major = 0, minor = 0;
    const std::string with_end(text);
    return std::sscanf(with_end.c_str(), "%d.%d", &major, &minor) == 2 ? major : 0;
}

class LegacyCheck {
public:
    explicit LegacyCheck(std::string_view content) : text_(content) {}

    void run()
    {
        check_header();
        for (std::string keyword = text_.word(); !keyword.empty(); keyword = text_.word())
            check_section(keyword);
        check_together();
    }

private:
    void check_header()
    {
        std::string_view first = text_.line();
        constexpr std::string_view signature = "# vtk DataFile Version";
        if (!first.starts_with(signature))
            throw InputError("not a legacy VTK file");
        offsets_ = major_version(first.substr(signature.size())) >= 5;
        text_.line(); // the title
        const std::string kind = text_.word("ASCII or BINARY");
        binary_ = kind.starts_with("binary");
        if (!binary_ && !kind.starts_with("ascii"))
            throw InputError(fmt::format("{} is neither ASCII nor BINARY", in_capitals(kind)));
        if (const std::string word = text_.word("DATASET"); !word.starts_with("dataset"))
            throw InputError(fmt::format("there is {} in the place of DATASET", in_capitals(word)));
        data_set_ = text_.word("the kind of data set");
        constexpr std::array kinds{"unstructured_grid", "polydata", "structured_points", "structured_grid",
                                   "rectilinear_grid"};
        if (std::none_of(kinds.begin(), kinds.end(), [&](const char* k) { return data_set_.starts_with(k); }))
            throw InputError(fmt::format("{} is not a kind of data set that visorder reads", in_capitals(data_set_)));
    }

    void check_section(const std::string& keyword)
    {
        const auto is = [&](std::string_view beginning) { return keyword.starts_with(beginning); };
        if (is("field")) {
            check_field();
        } else if (is("metadata")) {
            skip_metadata();
        } else if (is("point_data")) {
            turn("POINT_DATA", "points", text_.count("the number of points"), point_count());
        } else if (is("cell_data")) {
            turn("CELL_DATA", "cells", text_.count("the number of cells"), cell_count());
        } else if (tuples_) {
            check_attribute(keyword);
        } else {
            if (!sections_.insert(keyword).second)
                throw InputError(fmt::format("there are two sections of {}", in_capitals(keyword)));
            check_geometry(keyword);
        }
    }

    void check_geometry(const std::string& keyword)
    {
        const auto is = [&](std::string_view beginning) { return keyword.starts_with(beginning); };
        if (is("points")) {
            const std::uint64_t points = text_.count("the number of points");
            check_array(points, 3, "POINTS");
            points_ = points;
        } else if (is("cells")) {
            cells_ = read_cells("CELLS");
        } else if (is("cell_types")) {
            types_ = read_integers(text_.count("the number of cell types"), 4, "CELL_TYPES");
        } else if (is("vertices") || is("lines") || is("polygons") || is("triangle_strips")) {
            surface_cells_ += read_cells(in_capitals(keyword)).size();
        } else if (is("dimensions")) {
            read_dimensions();
        } else if (is("extent")) {
            read_extent();
        } else if (is("spacing") || is("aspect_ratio") || is("origin")) {
            text_.skip_numbers(3, in_capitals(keyword));
        } else if (is("x_coordinates") || is("y_coordinates") || is("z_coordinates")) {
            check_coordinates(static_cast<std::size_t>(keyword[0] - 'x'));
        } else if (is("blanking")) {
            check_array(text_.count("the number of blanked points"), 1, "BLANKING");
        } else {
            throw InputError(fmt::format("{} is not a section that it can have", in_capitals(keyword)));
        }
    }

    void check_attribute(const std::string& keyword)
    {
        const auto is = [&](std::string_view beginning) { return keyword.starts_with(beginning); };
        if (is("lookup_table")) {
            text_.word("the name of a lookup table");
            const std::uint64_t size = text_.count("the size of a lookup table");
            check_array_of(ValueType{binary_ ? ValueType::Kind::integer : ValueType::Kind::real, 1}, size, 4,
                           "LOOKUP_TABLE");
            return;
        }
        if (is("scalars")) {
            check_scalars();
        } else if (is("color_scalars")) {
            text_.word("the name of COLOR_SCALARS");
            const std::uint64_t components = text_.count("the number of components");
            check_array_of(ValueType{binary_ ? ValueType::Kind::integer : ValueType::Kind::real, 1}, *tuples_,
                           components, "COLOR_SCALARS");
        } else if (is("texture_coordinates")) {
            text_.word("the name of TEXTURE_COORDINATES");
            check_array(*tuples_, text_.count("the number of components"), "TEXTURE_COORDINATES");
        } else if (is("vectors") || is("normals")) {
            text_.word("the name of vectors");
            check_array(*tuples_, 3, in_capitals(keyword));
        } else if (is("tensors")) {
            text_.word("the name of tensors");
            check_array(*tuples_, is("tensors6") ? 6 : 9, in_capitals(keyword));
        } else if (is("global_ids") || is("pedigree_ids") || is("edge_flags")) {
            text_.word("the name of ids");
            check_array(*tuples_, 1, in_capitals(keyword));
        } else {
            throw InputError(fmt::format("{} is not a kind of point or cell data", in_capitals(keyword)));
        }
    }

    void check_scalars()
    {
        text_.word("the name of SCALARS");
        const std::string type = text_.word("the type of SCALARS");
        std::string next = text_.word("LOOKUP_TABLE");
        std::uint64_t components = 1;
        if (next != "lookup_table") {
            const char* const end = next.data() + next.size();
            if (const auto [stop, error] = std::from_chars(next.data(), end, components);
                error != std::errc() || stop != end)
                throw InputError(fmt::format("SCALARS: \"{}\" is not a number of components", printable(next)));
            next = text_.word("LOOKUP_TABLE");
        }
        if (next != "lookup_table")
            throw InputError("there is no LOOKUP_TABLE after SCALARS");
        text_.word("the name of a lookup table");
        check_array_of(type, *tuples_, components, "SCALARS");
    }

    void turn(const char* section, const char* of_what, std::uint64_t tuples, std::uint64_t expected)
    {
        if (tuples != expected)
            throw InputError(fmt::format("{} is of {} {}, but there are {}", section, tuples, of_what, expected));
        if (++turns_ > most_turns)
            throw InputError(fmt::format("there are more than {} sections of POINT_DATA and CELL_DATA", most_turns));
        tuples_ = tuples;
    }

    void check_field()
    {
        text_.word("the name of a FIELD");
        for (std::uint64_t left = text_.count("the number of arrays of a FIELD"); left > 0; --left) {
            std::string name = text_.word("the name of an array of a FIELD");
            if (name == "metadata") { // of the array before
                skip_metadata();
                name = text_.word("the name of an array of a FIELD");
            }
            if (name == "null_array")
                continue;
            const std::uint64_t components = text_.count("the number of components");
            const std::uint64_t tuples = text_.count("the number of values");
            check_array(tuples, components, "an array of a FIELD");
        }
    }

    /// Up to a blank line; what describes keys may have such lines before each.
    void skip_metadata()
    {
        text_.line();
        while (text_.bytes_left() > 0) {
            const std::string_view line = text_.line();
            if (line.find_first_not_of('\r') == std::string_view::npos && !goes_on())
                return;
        }
    }

    bool goes_on() const
    {
        LegacyText ahead = text_;
        const std::string word = ahead.word();
        return word == "name" || word == "data";
    }

    void read_dimensions()
    {
        dimensions_.emplace();
        for (std::uint64_t& points : *dimensions_) {
            points = text_.count("the number of points along an axis");
            if (points > std::numeric_limits<std::int32_t>::max())
                throw InputError(fmt::format("DIMENSIONS has {} points along an axis", points));
        }
        check_dimensions();
    }

    void check_dimensions() const
    {
        const auto& [x, y, z] = *dimensions_;
        if (y != 0 && z != 0 && x > std::numeric_limits<std::uint32_t>::max() / y / z)
            throw InputError(fmt::format("{} x {} x {} points are more than a mesh can have", x, y, z));
    }

    /// The first and the last point along each axis, in the place of DIMENSIONS.
    void read_extent()
    {
        dimensions_.emplace();
        for (std::uint64_t& points : *dimensions_) {
            const std::int64_t first = text_.integer("the first point along an axis");
            const std::int64_t last = text_.integer("the last point along an axis");
            constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
            if (first < -most || last > most || last < first)
                throw InputError(fmt::format("EXTENT goes from {} to {}", first, last));
            points = static_cast<std::uint64_t>(last - first) + 1;
        }
        check_dimensions();
    }

    void check_coordinates(std::size_t axis)
    {
        const std::uint64_t count = text_.count("the number of coordinates");
        if (!dimensions_ || count != (*dimensions_)[axis])
            throw InputError(
                fmt::format("{}_COORDINATES has {} values, which are not those of DIMENSIONS", "XYZ"[axis], count));
        check_array(count, 1, "coordinates");
        ++axes_;
    }

    std::uint64_t point_count() const
    {
        if (is_grid() && !data_set_.starts_with("structured_grid"))
            return dimensions_ ? (*dimensions_)[0] * (*dimensions_)[1] * (*dimensions_)[2] : 0;
        return points_;
    }

    std::uint64_t cell_count() const
    {
        if (!is_grid())
            return cells_.size() + surface_cells_;
        if (!dimensions_ || std::count(dimensions_->begin(), dimensions_->end(), 0) > 0)
            return 0;
        std::uint64_t cells = 1;
        for (const std::uint64_t points : *dimensions_)
            cells *= std::max<std::uint64_t>(points - 1, 1);
        return cells;
    }

    bool is_grid() const { return data_set_.starts_with("structured_") || data_set_.starts_with("rectilinear_grid"); }

    /// An array whose type stands before its values.
    void check_array(std::uint64_t tuples, std::uint64_t components, const std::string& of_what)
    {
        check_array_of(text_.word("the type of an array"), tuples, components, of_what);
    }

    void check_array_of(const std::string& type_word, std::uint64_t tuples, std::uint64_t components,
                        const std::string& of_what)
    {
        const auto type = value_type(type_word);
        if (!type)
            throw InputError(fmt::format("\"{}\" is not a type of values", printable(type_word)));
        check_array_of(*type, tuples, components, of_what);
    }

    void check_array_of(const ValueType& type, std::uint64_t tuples, std::uint64_t components,
                        const std::string& of_what)
    {
        if (components > most_components)
            throw InputError(fmt::format("{} has {} components", of_what, components));
        if (components == 0 && tuples > 0)
            throw InputError(fmt::format("{} has no components", of_what));
        if (tuples > 8 * text_.bytes_left() / std::max<std::uint64_t>(components, 1)) // even bits take more
            throw InputError(fmt::format("{} has {} values of {} components, but {} bytes are left in the file",
                                         of_what, tuples, components, text_.bytes_left()));
        const std::uint64_t values = tuples * components;
        using Kind = ValueType::Kind;
        switch (type.kind) {
        case Kind::integer:
        case Kind::real:
            if (values > 0)
                binary_ ? static_cast<void>(text_.binary(values * type.bytes, of_what))
                        : text_.skip_numbers(values, of_what);
            break;
        case Kind::bit:
            if (values > 0)
                binary_ ? static_cast<void>(text_.binary((values + 7) / 8, of_what))
                        : text_.skip_numbers(values, of_what);
            break;
        case Kind::string:
            if (binary_) {
                text_.skip_binary_strings(values, of_what);
            } else {
                skip_lines(values, of_what);
            }
            break;
        case Kind::variant:
            if (values > text_.bytes_left())
                throw InputError(fmt::format("the file ends within {}", of_what));
            for (std::uint64_t i = 0; i < values; ++i) {
                text_.integer("the type of a value");
                text_.word("a value");
            }
        }
    }

    void skip_lines(std::uint64_t count, const std::string& of_what)
    {
        text_.line();
        for (; count > 0; --count) {
            if (text_.bytes_left() == 0)
                throw InputError(fmt::format("the file ends within {}", of_what));
            text_.line();
        }
    }

    CellList read_cells(const std::string& section)
    {
        const std::int64_t first = text_.integer("the number of cells");
        const std::int64_t second = text_.integer("the size of a list of cells");
        if (first < 0 || second < 0)
            throw InputError(fmt::format("{} has the sizes {} and {}", section, first, second));
        const auto a = static_cast<std::uint64_t>(first), b = static_cast<std::uint64_t>(second);
        return offsets_ ? read_offset_cells(section, a, b) : read_counted_cells(section, a, b);
    }

    /// Whole numbers, as many as are said to follow.
    std::vector<std::int64_t> read_integers(std::uint64_t count, std::size_t bytes_each, const std::string& of_what)
    {
        std::vector<std::int64_t> numbers;
        if (binary_) {
            if (count > text_.bytes_left() / bytes_each)
                throw InputError(fmt::format("{} has {} numbers, but {} bytes are left in the file", of_what, count,
                                             text_.bytes_left()));
            const std::string_view bytes = text_.binary(count * bytes_each, of_what);
            numbers.resize(count);
            for (std::size_t i = 0; i < count; ++i)
                numbers[i] = big_endian(bytes.data() + i * bytes_each, bytes_each);
        } else {
            if (count > text_.bytes_left())
                throw InputError(fmt::format("{} has {} numbers, but {} bytes are left in the file", of_what, count,
                                             text_.bytes_left()));
            numbers.resize(count);
            text_.read_integers(numbers, of_what);
        }
        return numbers;
    }

    /// What a number that is too large may be a sign of.
    std::string hint_of_order(std::int64_t number, std::uint64_t most) const
    {
        const std::uint32_t swapped = __builtin_bswap32(static_cast<std::uint32_t>(number));
        return binary_ && swapped <= most ? ": it may not be big-endian, as it must" : "";
    }

    /// Before version 5: of each cell how many points it has, and those.
    CellList read_counted_cells(const std::string& section, std::uint64_t cells, std::uint64_t size)
    {
        CellList list;
        list.numbers = read_integers(size, 4, section);
        if (cells > size)
            throw InputError(fmt::format("{} has {} cells in {} numbers", section, cells, size));
        // The numbers stay where they are, counts included; a cell begins after its count.
        list.begins.clear();
        list.begins.reserve(cells + 1);
        std::size_t at = 0;
        for (std::uint64_t cell = 0; cell < cells; ++cell) {
            if (at >= size)
                throw InputError(fmt::format("{} has {} cells, but its numbers end in cell {}", section, cells, cell));
            const std::int64_t points = list.numbers[at++];
            if (points < 0 || static_cast<std::uint64_t>(points) > size - at)
                throw InputError(fmt::format("{}: cell {} has {} points, but {} numbers are left{}", section, cell,
                                             points, size - at, hint_of_order(points, size - at)));
            list.begins.push_back(at);
            at += static_cast<std::size_t>(points);
        }
        if (at != size)
            throw InputError(fmt::format("{} has {} numbers, but its {} cells take {}", section, size, cells, at));
        list.begins.push_back(at + 1);
        return list;
    }

    /// From version 5: where the points of each cell begin, and the points of all.
    CellList read_offset_cells(const std::string& section, std::uint64_t offsets, std::uint64_t size)
    {
        if (offsets == 0)
            return {};
        CellList list;
        const std::vector<std::int64_t> begins = read_named_integers("offsets", offsets);
        list.numbers = read_named_integers("connectivity", size);
        std::int64_t last = 0;
        list.begins.clear();
        for (std::size_t i = 0; i < begins.size(); ++i) {
            if (begins[i] < last || static_cast<std::uint64_t>(begins[i]) > size || (i == 0 && begins[i] != 0))
                throw InputError(
                    fmt::format("{}: offset {} is {} after {}, of {} numbers", section, i, begins[i], last, size));
            last = begins[i];
            list.begins.push_back(static_cast<std::size_t>(last));
        }
        if (static_cast<std::uint64_t>(last) != size)
            throw InputError(fmt::format("{}: the last offset is {}, of {} numbers", section, last, size));
        return list;
    }

    std::vector<std::int64_t> read_named_integers(const char* name, std::uint64_t count)
    {
        std::string found = text_.word(name);
        if (found == "metadata") { // of the array before
            skip_metadata();
            found = text_.word(name);
        }
        if (found != name)
            throw InputError(fmt::format("there is {} in the place of {}", printable(found), name));
        const std::string word = text_.word("the type of an array");
        const auto type = value_type(word);
        if (!type)
            throw InputError(fmt::format("\"{}\" is not a type of values", printable(word)));
        if (type->kind != ValueType::Kind::integer)
            throw InputError(fmt::format("{} are of the type {}", name, word));
        if (count == 0)
            return {};
        return read_integers(count, type->bytes, name);
    }

    /// What depends on several sections, which come in any order.
    void check_together() const
    {
        if (is_grid() && !dimensions_)
            throw InputError("there are no DIMENSIONS");
        if (data_set_.starts_with("structured_grid") &&
            points_ != (*dimensions_)[0] * (*dimensions_)[1] * (*dimensions_)[2])
            throw InputError(fmt::format("{} points are not the {} x {} x {} of DIMENSIONS", points_, (*dimensions_)[0],
                                         (*dimensions_)[1], (*dimensions_)[2]));
        if (data_set_.starts_with("rectilinear_grid") && axes_ < 3)
            throw InputError("there are not coordinates of all three axes");
        if (!data_set_.starts_with("unstructured_grid"))
            return;
        if (types_.size() != cells_.size())
            throw InputError(fmt::format("there are {} cells, but {} cell types", cells_.size(), types_.size()));
        for (std::size_t cell = 0; cell < types_.size(); ++cell)
            if (types_[cell] < 0 || types_[cell] > std::numeric_limits<unsigned char>::max())
                throw InputError(fmt::format("cell {}: there is no cell type {}", cell, types_[cell]));
            else if (types_[cell] == VTK_POLYHEDRON)
                check_polyhedron(cell);
            else
                check_points(cell);
    }

    /// VTK takes some numbers that are no points for the end of the list, and says that there are no cells.
    void check_points(std::size_t cell) const
    {
        const std::size_t end = cells_.begins[cell + 1] - (offsets_ ? 0 : 1);
        for (std::size_t at = cells_.begins[cell]; at < end; ++at)
            if (cells_.numbers[at] < 0 || static_cast<std::uint64_t>(cells_.numbers[at]) >= points_)
                throw InputError(fmt::format("cell {}: there is no point {}", cell, cells_.numbers[at]));
    }

    /// The numbers of a polyhedron are how many faces it has, and of each how many points, and those.
    void check_polyhedron(std::size_t cell) const
    {
        std::size_t at = cells_.begins[cell];
        const std::size_t end = cells_.begins[cell + 1] - (offsets_ ? 0 : 1);
        const auto next_count = [&] {
            const std::int64_t count = at < end ? cells_.numbers[at++] : -1;
            if (count < 0 || static_cast<std::uint64_t>(count) > end - at)
                throw InputError(fmt::format("cell {}: the faces of the polyhedron go beyond its {} numbers", cell,
                                             end - cells_.begins[cell]));
            return static_cast<std::size_t>(count);
        };
        for (std::size_t faces = next_count(); faces > 0; --faces)
            for (std::size_t points = next_count(); points > 0; --points, ++at)
                if (cells_.numbers[at] < 0 || static_cast<std::uint64_t>(cells_.numbers[at]) >= points_)
                    throw InputError(fmt::format("cell {}: there is no point {}", cell, cells_.numbers[at]));
        if (at != end)
            throw InputError(fmt::format("cell {}: the faces of the polyhedron take {} numbers, not {}", cell,
                                         at - cells_.begins[cell], end - cells_.begins[cell]));
    }

    LegacyText text_;
    bool binary_ = false;
    bool offsets_ = false; // lists of cells are those of version 5
    std::string data_set_;
    std::set<std::string> sections_; // of the geometry, by their first words
    std::uint64_t points_ = 0;
    CellList cells_;
    std::uint64_t surface_cells_ = 0;
    std::vector<std::int64_t> types_;
    std::optional<std::array<std::uint64_t, 3>> dimensions_;
    int axes_ = 0;                        // that have coordinates
    std::optional<std::uint64_t> tuples_; // of the arrays in the section at hand
    int turns_ = 0;
};

} // namespace

void check_legacy_content(std::string_view content)
{
    LegacyCheck(content).run();
}

void check_legacy_file(const std::filesystem::path& path)
{
    const MappedFile file(path);
    try {
        check_legacy_content(file.content());
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: cannot be read: {}", path.string(), error.what()));
    }
}

} // namespace visorder::detail
