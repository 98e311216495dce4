// After Turk, The PLY polygon file format, 1994.

#include "files/ply_file.h"

#include "files/byte_scanner.h"
#include "files/ply_header.h"
#include "files/text_scanner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace visorder::detail {

namespace {

// What looks are made of rather than data.
constexpr std::array looks{
    "nx", "ny", "nz", "red",       "green",     "blue",        "alpha",         "r",           "g", "b", "a", "s",
    "t",  "u",  "v",  "texture_u", "texture_v", "diffuse_red", "diffuse_green", "diffuse_blue"};

/// Reads the numbers of a text.
class TextNumbers {
public:
    TextNumbers(const std::filesystem::path& path, std::string_view content, const PlyHeader& header)
        : scanner_(path, content)
    {
        scanner_.skip_to(header.end);
    }

    double read(PlyType) { return scanner_.real("a number"); }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }
    std::size_t remaining() const { return scanner_.text().size() - scanner_.position(); }
    static std::size_t least_bytes(PlyType) { return 1; }

private:
    TextScanner scanner_;
};

/// Reads the numbers of a binary file.
class BinaryNumbers {
public:
    BinaryNumbers(const std::filesystem::path& path, std::string_view content, const PlyHeader& header)
        : scanner_(path, content,
                   (header.encoding == PlyHeader::Encoding::little_endian) !=
                       (std::endian::native == std::endian::little))
    {
        scanner_.skip_to(header.end);
    }

    double read(PlyType type)
    {
        switch (type) {
        case PlyType::int8:
            return scanner_.read<std::int8_t>("a number");
        case PlyType::uint8:
            return scanner_.read<std::uint8_t>("a number");
        case PlyType::int16:
            return scanner_.read<std::int16_t>("a number");
        case PlyType::uint16:
            return scanner_.read<std::uint16_t>("a number");
        case PlyType::int32:
            return scanner_.read<std::int32_t>("a number");
        case PlyType::uint32:
            return scanner_.read<std::uint32_t>("a number");
        case PlyType::float32:
            return scanner_.read<float>("a number");
        case PlyType::float64:
            return scanner_.read<double>("a number");
        }
        return 0;
    }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }
    std::size_t remaining() const { return scanner_.remaining(); }
    static std::size_t least_bytes(PlyType type) { return bytes_of(type); }

private:
    ByteScanner scanner_;
};

template <class Numbers>
class PlyContent {
public:
    PlyContent(const std::filesystem::path& path, const PlyHeader& header, Numbers numbers)
        : header_(header), numbers_(std::move(numbers))
    {
        grid_.path = path;
    }

    FileGrid run()
    {
        for (const PlyElement& element : header_.elements) {
            check_room(element);
            if (element.name == "vertex")
                read_points(element);
            else
                read_cells(element);
        }
        return std::move(grid_);
    }

private:
    void check_room(const PlyElement& element) const
    {
        std::size_t bytes = 0;
        for (const PlyProperty& property : element.properties)
            bytes += numbers_.least_bytes(property.is_list ? property.count_type : property.type);
        if (bytes == 0 ? element.count > 0 : element.count > numbers_.remaining() / bytes + 1)
            numbers_.fail(fmt::format("{} {} elements are more than the rest of the file has room for", element.count,
                                      element.name));
    }

    /// An array for each property that is a number, and is none of `others`.
    std::vector<std::shared_ptr<std::vector<double>>> add_arrays(const PlyElement& element, bool on_cells,
                                                                 std::span<const char* const> others)
    {
        std::vector<std::shared_ptr<std::vector<double>>> values(element.properties.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.is_list || std::find(others.begin(), others.end(), property.name) != others.end())
                continue;
            values[i] = std::make_shared<std::vector<double>>();
            const bool is_look = std::find(looks.begin(), looks.end(), property.name) != looks.end();
            grid_.arrays.push_back({property.name, on_cells, 1, is_look, [data = values[i]] { return *data; }});
        }
        return values;
    }

    void read_points(const PlyElement& element)
    {
        constexpr std::array<const char*, 3> axes{"x", "y", "z"};
        for (const char* axis : axes)
            if (std::none_of(element.properties.begin(), element.properties.end(),
                             [&](const PlyProperty& property) { return property.name == axis && !property.is_list; }))
                numbers_.fail(fmt::format("points have no {}", axis));
        const auto values = add_arrays(element, false, axes);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            glm::dvec3 point(0);
            for (std::size_t k = 0; k < element.properties.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (property.is_list) {
                    skip_list(property);
                    continue;
                }
                const double value = numbers_.read(property.type);
                const auto* axis = std::find(axes.begin(), axes.end(), property.name);
                if (axis != axes.end())
                    point[static_cast<int>(axis - axes.begin())] = value;
                else
                    values[k]->push_back(value);
            }
            grid_.points.push_back(point);
        }
    }

    static bool holds_corners(const PlyElement& element, const PlyProperty& property)
    {
        return property.is_list && (element.name == "face" || element.name == "tristrips") &&
               (property.name == "vertex_indices" || property.name == "vertex_index");
    }

    void read_cells(const PlyElement& element)
    {
        const bool has_corners =
            std::any_of(element.properties.begin(), element.properties.end(),
                        [&](const PlyProperty& property) { return holds_corners(element, property); });
        const bool is_face = element.name == "face";
        if (is_face && !has_corners)
            numbers_.fail("faces have no vertex_indices");
        std::vector<std::shared_ptr<std::vector<double>>> values(element.properties.size());
        if (is_face)
            values = add_arrays(element, true, {});
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (std::size_t k = 0; k < element.properties.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (holds_corners(element, property))
                    read_corners(property, is_face);
                else if (property.is_list)
                    skip_list(property);
                else if (const double value = numbers_.read(property.type); values[k])
                    values[k]->push_back(value);
            }
    }

    std::size_t read_length(const PlyProperty& property)
    {
        const double length = numbers_.read(property.count_type);
        const std::size_t most = numbers_.remaining() / numbers_.least_bytes(property.type) + 1;
        if (!(length >= 0) || length != std::floor(length) || length > static_cast<double>(most))
            numbers_.fail(fmt::format("a list of {} numbers", length));
        return static_cast<std::size_t>(length);
    }

    void skip_list(const PlyProperty& property)
    {
        for (std::size_t left = read_length(property); left > 0; --left)
            numbers_.read(property.type);
    }

    /// A face, or strips of triangles that -1 ends.
    void read_corners(const PlyProperty& property, bool is_face)
    {
        corners_.clear();
        const auto end_cell = [&] {
            const ListedShape shape = is_face ? ListedShape::polygon : ListedShape::strip;
            if (is_face || !corners_.empty())
                grid_.add({corners_.size() < 3 ? ListedShape::lower : shape}, corners_);
            corners_.clear();
        };
        for (std::size_t left = read_length(property); left > 0; --left) {
            const double corner = numbers_.read(property.type);
            if (corner != std::floor(corner) || std::abs(corner) > 1e15)
                numbers_.fail(fmt::format("{} is no number of a point", corner));
            if (corner == -1 && !is_face)
                end_cell();
            else
                corners_.push_back(static_cast<std::int64_t>(corner));
        }
        end_cell();
    }

    const PlyHeader& header_;
    Numbers numbers_;
    FileGrid grid_;
    std::vector<std::int64_t> corners_;
};

} // namespace

FileGrid read_ply_file(const std::filesystem::path& path, std::string_view content)
{
    const PlyHeader header = read_ply_header(path, content);
    if (header.encoding == PlyHeader::Encoding::text)
        return PlyContent(path, header, TextNumbers(path, content, header)).run();
    return PlyContent(path, header, BinaryNumbers(path, content, header)).run();
}

} // namespace visorder::detail
