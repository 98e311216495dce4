// Object File Format as Geomview's manual has it: [ST][C][N][4][n]OFF, of which points of four or n coordinates are
// refused. Each point and each face of a text has a line of its own, on which colours may follow.

#include "files/off_file.h"

#include "files/byte_scanner.h"
#include "files/text_scanner.h"

#include <bit>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

/// What the first word of a file says.
struct Kind {
    bool is_off = false;
    int numbers_after_coordinates = 0; // per point, of a binary file
};

Kind kind_of(std::string_view word)
{
    Kind kind;
    const auto take = [&](std::string_view prefix) {
        const bool found = word.starts_with(prefix);
        if (found)
            word.remove_prefix(prefix.size());
        return found;
    };
    const bool texture = take("ST");
    const bool colour = take("C");
    const bool normal = take("N");
    kind.is_off = word == "OFF";
    kind.numbers_after_coordinates = (normal ? 3 : 0) + (colour ? 4 : 0) + (texture ? 2 : 0);
    return kind;
}

void add_face(FileGrid& grid, const std::vector<std::int64_t>& corners)
{
    grid.add({corners.size() < 3 ? ListedShape::lower : ListedShape::polygon}, corners);
}

void read_text(TextScanner& scanner, FileGrid& grid, std::string_view points_word)
{
    const std::int64_t point_count = points_word.empty()
                                         ? static_cast<std::int64_t>(scanner.count("the number of points", 6))
                                         : scanner.integer_of(points_word);
    if (point_count < 0 || static_cast<std::size_t>(point_count) > scanner.text().size() / 6 + 1)
        scanner.fail(fmt::format("the number of points is {}, more than the file has room for", point_count));
    const std::size_t faces = scanner.count("the number of faces");
    scanner.rest_of_line(); // the number of edges, which need not be right
    for (std::int64_t i = 0; i < point_count; ++i) {
        const double x = scanner.real("a point");
        const double y = scanner.real("a point");
        const double z = scanner.real("a point");
        grid.points.emplace_back(x, y, z);
        scanner.rest_of_line();
    }
    std::vector<std::int64_t> corners;
    for (std::size_t i = 0; i < faces; ++i) {
        corners.clear();
        for (std::size_t left = scanner.count("a face's number of corners"); left > 0; --left)
            corners.push_back(scanner.integer("a face's corner"));
        add_face(grid, corners);
        scanner.rest_of_line();
    }
}

void read_binary(ByteScanner& scanner, FileGrid& grid, int numbers_after_coordinates)
{
    const auto points = scanner.read<std::uint32_t>("the number of points");
    const auto faces = scanner.read<std::uint32_t>("the number of faces");
    scanner.read<std::uint32_t>("the number of edges");
    const auto after = static_cast<std::size_t>(numbers_after_coordinates) * sizeof(float);
    scanner.expect_room(points, 3 * sizeof(float) + after, "points");
    for (std::uint32_t i = 0; i < points; ++i) {
        const auto x = scanner.read<float>("a point");
        const auto y = scanner.read<float>("a point");
        const auto z = scanner.read<float>("a point");
        grid.points.emplace_back(x, y, z);
        scanner.take(after, "a point");
    }
    scanner.expect_room(faces, 2 * sizeof(std::uint32_t), "faces");
    std::vector<std::int64_t> corners;
    for (std::uint32_t i = 0; i < faces; ++i) {
        const auto count = scanner.read<std::uint32_t>("a face");
        scanner.expect_room(count, sizeof(std::uint32_t), "corners of a face");
        corners.clear();
        for (std::uint32_t k = 0; k < count; ++k)
            corners.push_back(scanner.read<std::int32_t>("a face"));
        const auto colours = scanner.read<std::uint32_t>("a face's colour");
        scanner.expect_room(colours, sizeof(float), "components of a colour");
        scanner.take(colours * sizeof(float), "a face's colour");
        add_face(grid, corners);
    }
}

} // namespace

FileGrid read_off_file(const std::filesystem::path& path, std::string_view content)
{
    FileGrid grid;
    grid.path = path;
    TextScanner scanner(path, content, '#');
    const std::string_view first = scanner.word("the word OFF");
    const Kind kind = kind_of(first);
    if (!kind.is_off) {
        if (first.find_first_not_of("0123456789") != std::string_view::npos)
            scanner.fail("not an OFF file of points with three coordinates");
        read_text(scanner, grid, first); // the word OFF may be missing
        return grid;
    }
    const std::size_t after_keyword = scanner.position();
    if (scanner.word_on_line() == "BINARY") {
        scanner.rest_of_line();
        ByteScanner bytes(path, content, std::endian::native == std::endian::little);
        bytes.skip_to(scanner.position());
        read_binary(bytes, grid, kind.numbers_after_coordinates);
    } else {
        TextScanner again(path, content, '#');
        again.skip_to(after_keyword);
        read_text(again, grid, {});
    }
    return grid;
}

} // namespace visorder::detail
