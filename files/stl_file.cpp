#include "files/stl_file.h"

#include "files/byte_scanner.h"
#include "files/point_joining.h"
#include "files/printable.h"
#include "files/text_scanner.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <numeric>

namespace visorder::detail {

namespace {

constexpr std::size_t header_bytes = 80;
constexpr std::size_t triangle_bytes = 12 * sizeof(float) + 2;

bool equal_without_case(std::string_view a, std::string_view b)
{
    const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return small(x) == small(y); });
}

void expect(TextScanner& scanner, std::string_view found, const char* wanted)
{
    if (!equal_without_case(found, wanted))
        scanner.fail(fmt::format("\"{}\" stands where {} should", printable(found), wanted));
}

/// "facet normal x y z outer loop vertex ... endloop endfacet", without the first word.
void read_facet(TextScanner& scanner, FileGrid& grid)
{
    expect(scanner, scanner.word("normal"), "normal");
    for (int i = 0; i < 3; ++i)
        scanner.word("a normal"); // some programs write what is no number
    expect(scanner, scanner.word("outer"), "outer");
    expect(scanner, scanner.word("loop"), "loop");
    for (int i = 0; i < 3; ++i) {
        expect(scanner, scanner.word("vertex"), "vertex");
        const double x = scanner.real("a vertex");
        const double y = scanner.real("a vertex");
        const double z = scanner.real("a vertex");
        grid.points.emplace_back(x, y, z);
    }
    expect(scanner, scanner.word("endloop"), "endloop");
    expect(scanner, scanner.word("endfacet"), "endfacet");
}

/// Lists what is read so far as triangles.
void add_triangles(FileGrid& grid)
{
    for (auto first = static_cast<std::int64_t>(3 * grid.cells.size());
         first < static_cast<std::int64_t>(grid.points.size()); first += 3)
        grid.add({ListedShape::polygon}, std::array{first, first + 1, first + 2});
}

void read_text(const std::filesystem::path& path, std::string_view content, FileGrid& grid)
{
    TextScanner scanner(path, content);
    bool in_solid = false;
    for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
        if (!in_solid) {
            expect(scanner, word, "solid");
            const std::string name = printable(scanner.rest_of_line());
            add_triangles(grid);
            grid.blocks.push_back(
                {name.empty() ? fmt::format("solid {}", grid.blocks.size()) : name, grid.cells.size()});
            in_solid = true;
        } else if (equal_without_case(word, "facet")) {
            read_facet(scanner, grid);
        } else {
            expect(scanner, word, "endsolid");
            scanner.rest_of_line();
            in_solid = false;
        }
    }
    if (in_solid)
        scanner.fail("the file ends where endsolid should be");
    if (grid.blocks.size() == 1)
        grid.blocks.clear();
    add_triangles(grid);
}

void read_binary(const std::filesystem::path& path, std::string_view content, FileGrid& grid)
{
    ByteScanner scanner(path, content, std::endian::native == std::endian::big);
    scanner.take(header_bytes, "the header");
    const auto triangles = scanner.read<std::uint32_t>("the number of triangles");
    scanner.expect_room(triangles, triangle_bytes, "triangles");
    grid.points.reserve(std::size_t{3} * triangles);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        scanner.take(3 * sizeof(float), "a normal");
        for (int k = 0; k < 3; ++k) {
            const auto x = scanner.read<float>("a vertex");
            const auto y = scanner.read<float>("a vertex");
            const auto z = scanner.read<float>("a vertex");
            grid.points.emplace_back(x, y, z);
        }
        scanner.take(2, "a triangle's attributes");
    }
    add_triangles(grid);
}

bool is_binary(const std::filesystem::path& path, std::string_view content)
{
    if (content.size() < header_bytes + 4)
        return false;
    ByteScanner scanner(path, content, std::endian::native == std::endian::big);
    scanner.skip_to(header_bytes);
    const auto triangles = scanner.read<std::uint32_t>("the number of triangles");
    // The headers of some binary files begin with "solid", too.
    if (content.size() == header_bytes + 4 + std::size_t{triangles} * triangle_bytes)
        return true;
    TextScanner text(path, content);
    return !equal_without_case(text.word(), "solid");
}

void join_equal_points(FileGrid& grid)
{
    const JoinedPoints joined = join_all(grid.points);
    std::vector<glm::dvec3> kept;
    for (const PointId point : joined.kept)
        kept.push_back(grid.points[point]);
    grid.points = std::move(kept);
    for (std::int64_t& corner : grid.corners)
        corner = joined.number[static_cast<std::size_t>(corner)];
}

} // namespace

FileGrid read_stl_file(const std::filesystem::path& path, std::string_view content)
{
    FileGrid grid;
    grid.path = path;
    if (is_binary(path, content))
        read_binary(path, content, grid);
    else
        read_text(path, content, grid);
    join_equal_points(grid);
    return grid;
}

} // namespace visorder::detail
