// After Frey, MEDIT: an interactive mesh visualization software, INRIA RT-0253, 2001, and the keywords of libMeshb.

#include "files/medit_file.h"

#include "files/printable.h"
#include "files/text_scanner.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

/// A keyword that lists cells, each by its points and a reference number.
struct CellKeyword {
    std::string_view word;
    ListedShape shape;
    std::size_t points;
    std::size_t corners; ///< the first of the points
};

constexpr std::array cell_keywords{
    CellKeyword{"Edges", ListedShape::lower, 2, 2},
    CellKeyword{"Triangles", ListedShape::polygon, 3, 3},
    CellKeyword{"Quadrilaterals", ListedShape::polygon, 4, 4},
    CellKeyword{"Tetrahedra", ListedShape::tetrahedron, 4, 4},
    CellKeyword{"Pyramids", ListedShape::pyramid, 5, 5},
    CellKeyword{"Prisms", ListedShape::wedge, 6, 6},
    CellKeyword{"Pentahedra", ListedShape::wedge, 6, 6},
    CellKeyword{"Hexahedra", ListedShape::hexahedron, 8, 8},
    CellKeyword{"Hexaedra", ListedShape::hexahedron, 8, 8},
    CellKeyword{"EdgesP2", ListedShape::lower, 3, 2},
    CellKeyword{"TrianglesP2", ListedShape::polygon, 6, 3},
    CellKeyword{"QuadrilateralsQ2", ListedShape::polygon, 9, 4},
    CellKeyword{"TetrahedraP2", ListedShape::tetrahedron, 10, 4},
    CellKeyword{"PyramidsP2", ListedShape::pyramid, 14, 5},
    CellKeyword{"PrismsP2", ListedShape::wedge, 18, 6},
    CellKeyword{"HexahedraQ2", ListedShape::hexahedron, 27, 8},
};

bool is_letter(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

class MeditParser {
public:
    MeditParser(const std::filesystem::path& path, std::string_view content) : scanner_(path, content, '#')
    {
        grid_.path = path;
    }

    FileGrid run()
    {
        if (scanner_.word("MeshVersionFormatted") != "MeshVersionFormatted")
            scanner_.fail("not a MEDIT mesh in text, which begins with MeshVersionFormatted");
        scanner_.integer("the version");
        for (std::string_view keyword = scanner_.word(); !keyword.empty() && keyword != "End";)
            keyword = read_section(keyword);
        return std::move(grid_);
    }

private:
    /// Reads what belongs to a keyword; gives the one after it, empty at the end.
    std::string_view read_section(std::string_view keyword)
    {
        if (!is_letter(keyword.front()))
            scanner_.fail(fmt::format("\"{}\" stands where a keyword should", printable(keyword)));
        if (keyword == "Dimension") {
            dimension_ = scanner_.integer("the dimension");
            if (dimension_ != 2 && dimension_ != 3)
                scanner_.fail(fmt::format("points of {} coordinates", dimension_));
        } else if (keyword == "Vertices") {
            read_points();
        } else if (const auto* cells = std::find_if(cell_keywords.begin(), cell_keywords.end(),
                                                    [&](const CellKeyword& known) { return known.word == keyword; });
                   cells != cell_keywords.end()) {
            read_cells(*cells);
        } else {
            // Corners, ridges, normals, and whatever else there may be: up to the next word.
            std::string_view word = scanner_.word();
            while (!word.empty() && !is_letter(word.front()))
                word = scanner_.word();
            return word;
        }
        return scanner_.word();
    }

    void read_points()
    {
        const std::size_t count = scanner_.count("the number of points", 4);
        if (!grid_.points.empty())
            scanner_.fail("a second list of points");
        grid_.points.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            glm::dvec3 point(0);
            for (int axis = 0; axis < dimension_; ++axis)
                point[axis] = scanner_.real("a point's coordinate");
            scanner_.word("a point's reference");
            grid_.points.push_back(point);
        }
    }

    void read_cells(const CellKeyword& keyword)
    {
        const std::size_t count = scanner_.count("the number of cells", 2 * keyword.points);
        std::array<std::int64_t, 27> points{};
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < keyword.points; ++k) {
                points[k] = scanner_.integer("a cell's point");
                if (points[k] < 1)
                    scanner_.fail(fmt::format("there is no point {}, they are counted from 1", points[k]));
                --points[k];
            }
            scanner_.word("a cell's reference");
            if (keyword.shape == ListedShape::wedge) {
                // Seen from outside, VTK's wedge begins with a triangle that runs the other way round.
                std::swap(points[1], points[2]);
                std::swap(points[4], points[5]);
            }
            grid_.add({keyword.shape, keyword.points > keyword.corners},
                      std::span(points).first(keyword.shape == ListedShape::lower ? 0 : keyword.corners));
        }
    }

    TextScanner scanner_;
    FileGrid grid_;
    std::int64_t dimension_ = 3;
};

} // namespace

FileGrid read_medit_file(const std::filesystem::path& path, std::string_view content)
{
    return MeditParser(path, content).run();
}

FileGrid read_medit_binary_file(const std::filesystem::path& path, std::string_view)
{
    throw InputError(fmt::format("{}: a MEDIT mesh in binary is not read; one in text (.mesh) is", path.string()));
}

} // namespace visorder::detail
