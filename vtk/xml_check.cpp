#include "vtk/xml_check.h"

#include "files/mapped_file.h"
#include "visorder/error.h"
#include "vtk/xml_array.h"
#include "vtk/xml_tree.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <sstream>

namespace visorder::detail {

namespace {

constexpr std::int64_t most_components = 100'000;
constexpr std::uint64_t most_tuples = std::numeric_limits<std::uint32_t>::max(); // as points of a mesh

class XmlCheck {
public:
    XmlCheck(std::string_view content, const XmlTree& tree)
        : content_(content), tree_(tree), encoding_(XmlEncoding::of(tree))
    {
    }

    void run()
    {
        for (const XmlElement& data_set : tree_.root.children) {
            if (!data_set.attribute("WholeExtent").empty())
                points_of_extent(data_set.attribute("WholeExtent"));
            for (const XmlElement& child : data_set.children) {
                if (child.name == "Piece")
                    check_piece(child);
                else if (child.name == "FieldData")
                    for (const XmlElement& array : child.children)
                        check_array(array, array.number("NumberOfTuples").value_or(0), "tuples");
            }
        }
        for (const std::uint64_t total : {points_, cells_})
            if (total > most_tuples)
                throw InputError(fmt::format("{} points or cells are more than a mesh can have", total));
    }

private:
    std::uint64_t count(const XmlElement& piece, const char* attribute) const
    {
        const std::int64_t number = piece.number(attribute).value_or(0); // VTK refuses a piece without
        if (number < 0 || static_cast<std::uint64_t>(number) > most_tuples)
            throw InputError(fmt::format("{} is {}", attribute, number));
        return static_cast<std::uint64_t>(number);
    }

    /// The points along each axis.
    static std::array<std::uint64_t, 3> points_of_extent(const std::string& extent)
    {
        std::istringstream text(extent);
        std::array<std::uint64_t, 3> points{};
        std::uint64_t all = 1;
        for (std::uint64_t& n : points) {
            std::int64_t first = 0, last = 0;
            constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
            if (!(text >> first >> last) || first < -most || last > most)
                throw InputError(fmt::format("the extent \"{}\" is none", extent));
            n = last < first ? 0 : static_cast<std::uint64_t>(last - first) + 1;
            if (n > most_tuples / std::max<std::uint64_t>(all, 1))
                throw InputError(fmt::format("the extent \"{}\" has more points than a mesh can have", extent));
            all *= n;
        }
        return points;
    }

    void check_piece(const XmlElement& piece)
    {
        std::uint64_t points = count(piece, "NumberOfPoints"), cells = count(piece, "NumberOfCells");
        for (const char* kind : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys"})
            cells += count(piece, kind);
        if (const std::string& extent = piece.attribute("Extent"); !extent.empty()) {
            const auto size = points_of_extent(extent);
            points = size[0] * size[1] * size[2];
            cells = points == 0 ? 0 : 1;
            for (const std::uint64_t n : size)
                cells *= std::max<std::uint64_t>(n, 2) - 1;
        }
        points_ += points;
        cells_ += cells;
        for (const XmlElement& child : piece.children) {
            const auto check_arrays = [&](std::uint64_t tuples, const char* of_what) {
                for (const XmlElement& array : child.children)
                    check_array(array, static_cast<std::int64_t>(tuples), of_what);
            };
            if (child.name == "PointData" || child.name == "Points")
                check_arrays(points, "points");
            else if (child.name == "CellData")
                check_arrays(cells, "cells");
            else if (child.name == "Cells")
                check_cells(child, points, cells);
            else if (child.name == "Verts" || child.name == "Lines" || child.name == "Strips" || child.name == "Polys")
                check_cells(child, points, count(piece, ("NumberOf" + child.name).c_str()));
            else
                check_arrays(0, "values"); // coordinates, whose number VTK checks
        }
    }

    /// Whether it is one of numbers, and how many components it has.
    void check_array(const XmlElement& element, std::int64_t tuples, const char* of_what) const
    {
        if (element.name != "DataArray" && element.name != "Array")
            return;
        const std::int64_t components = element.number("NumberOfComponents").value_or(1);
        const XmlArray array(content_, tree_, encoding_, element);
        if (components < 0 || components > most_components)
            throw InputError(fmt::format("{} has {} components", array.name(), components));
        if (tuples < 0 || (components > 0 && static_cast<std::uint64_t>(tuples) >
                                                 array.most_values() / static_cast<std::uint64_t>(components)))
            throw InputError(
                fmt::format("{} is too short for {} {} and {} components", array.name(), tuples, of_what, components));
    }

    void check_cells(const XmlElement& section, std::uint64_t points, std::uint64_t cells) const
    {
        const XmlElement* faces = nullptr;
        const XmlElement* face_offsets = nullptr;
        for (const XmlElement& array : section.children) {
            const std::string& name = array.attribute("Name");
            const bool one_per_cell = name == "offsets" || name == "types" || name == "faceoffsets";
            check_array(array, one_per_cell ? static_cast<std::int64_t>(cells) : 0, "cells");
            if (name == "faces" && !faces)
                faces = &array;
            if (name == "faceoffsets" && !face_offsets)
                face_offsets = &array;
        }
        if (faces && face_offsets)
            check_polyhedra(XmlArray(content_, tree_, encoding_, *faces).integers(),
                            XmlArray(content_, tree_, encoding_, *face_offsets).integers(), points, cells);
    }

    /// Of each cell how far its faces go, -1 if it is no polyhedron. Its faces: how many, of each how many points,
    /// those.
    static void check_polyhedra(const std::vector<std::int64_t>& faces, const std::vector<std::int64_t>& ends,
                                std::uint64_t points, std::uint64_t cells)
    {
        std::size_t at = 0;
        for (std::size_t cell = 0; cell < std::min<std::uint64_t>(cells, ends.size()); ++cell) {
            if (ends[cell] == -1)
                continue;
            if (ends[cell] < 0 || static_cast<std::uint64_t>(ends[cell]) > faces.size())
                throw InputError(
                    fmt::format("cell {}: its faces end at {} of {} numbers", cell, ends[cell], faces.size()));
            const auto end = static_cast<std::size_t>(ends[cell]);
            const auto next_count = [&] {
                const std::int64_t count = at < end ? faces[at++] : -1;
                if (count < 0 || static_cast<std::uint64_t>(count) > end - at)
                    throw InputError(fmt::format("cell {}: the faces of the polyhedron go beyond their numbers", cell));
                return static_cast<std::size_t>(count);
            };
            for (std::size_t left = next_count(); left > 0; --left)
                for (std::size_t corners = next_count(); corners > 0; --corners, ++at)
                    if (faces[at] < 0 || static_cast<std::uint64_t>(faces[at]) >= points)
                        throw InputError(fmt::format("cell {}: there is no point {}", cell, faces[at]));
            if (at != end)
                throw InputError(fmt::format("cell {}: the faces of the polyhedron end before their numbers", cell));
        }
    }

    std::string_view content_;
    const XmlTree& tree_;
    XmlEncoding encoding_;
    std::uint64_t points_ = 0;
    std::uint64_t cells_ = 0;
};

} // namespace

void check_xml_content(std::string_view content)
{
    if (const auto tree = xml_tree(content); tree && tree->root.name == "VTKFile")
        XmlCheck(content, *tree).run();
}

void check_xml_file(const std::filesystem::path& path)
{
    const MappedFile file(path);
    try {
        check_xml_content(file.content());
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: cannot be read: {}", path.string(), error.what()));
    }
}

} // namespace visorder::detail
