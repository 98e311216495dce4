#include "files/file_grid.h"

#include "files/array_choice.h"
#include "files/convex_hull.h"
#include "files/point_joining.h"
#include "files/polygon.h"
#include "files/polyhedron.h"
#include "files/unused_points.h"
#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace visorder::detail {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Cells cut beyond this would not fit a mesh; far more than the largest prism or polyhedron makes are added at once.
constexpr std::size_t max_cells = std::size_t{1} << 29;

const char* name(ListedShape shape)
{
    switch (shape) {
    case ListedShape::empty:
        return "empty cell";
    case ListedShape::lower:
        return "point or line";
    case ListedShape::polygon:
        return "polygon";
    case ListedShape::strip:
        return "strip of triangles";
    case ListedShape::tetrahedron:
        return "tetrahedron";
    case ListedShape::pyramid:
        return "pyramid";
    case ListedShape::wedge:
        return "wedge";
    case ListedShape::hexahedron:
        return "hexahedron";
    case ListedShape::pentagonal_prism:
        return "pentagonal prism";
    case ListedShape::hexagonal_prism:
        return "hexagonal prism";
    case ListedShape::convex_hull:
        return "convex point set";
    case ListedShape::polyhedron:
        return "polyhedron";
    }
    return "cell";
}

bool is_surface(ListedShape shape)
{
    return shape == ListedShape::polygon || shape == ListedShape::strip;
}

/// How many corners a shape has; 0 where that varies.
std::size_t corner_count(ListedShape shape)
{
    switch (shape) {
    case ListedShape::tetrahedron:
        return 4;
    case ListedShape::pyramid:
        return 5;
    case ListedShape::wedge:
        return 6;
    case ListedShape::hexahedron:
        return 8;
    case ListedShape::pentagonal_prism:
        return 10;
    case ListedShape::hexagonal_prism:
        return 12;
    default:
        return 0;
    }
}

class GridConversion {
public:
    GridConversion(FileGrid&& grid, const ReadOptions& options) : grid_(std::move(grid)), options_(options)
    {
        result_.notes = std::move(grid_.notes);
        result_.blocks = std::move(grid_.blocks);
    }

    MeshFile run()
    {
        const FileArray* array = choose_array(grid_, options_.scalar);
        if (options_.list_arrays)
            for (const FileArray& listed : grid_.arrays)
                result_.arrays.push_back(summary_of(listed));
        if (grid_.cells.empty())
            fail("there are no cells in it");
        if (std::max(grid_.points.size(), grid_.cells.size()) > std::numeric_limits<PointId>::max())
            fail(fmt::format("{} points and {} cells are more than a mesh can have", grid_.points.size(),
                             grid_.cells.size()));
        join_points();
        solids_ = std::any_of(grid_.cells.begin(), grid_.cells.end(),
                              [](const ListedCell& cell) { return !cell.hidden && cell.shape > ListedShape::strip; });
        for (cell_ = 0; cell_ < grid_.cells.size(); ++cell_)
            convert_cell();
        if (mesh().cell_count() == 0)
            fail("there are no solid or surface cells in it");
        if (array)
            take(*array);
        tell(array);
        note(drop_unused_points(mesh()), "points that no cell uses left out");
        note(joined_, !options_.weld                ? "points joined with those of other pieces at the same coordinates"
                      : options_.weld_tolerance > 0 ? "points joined with others near them"
                                                    : "points joined with others of the same coordinates");
        return std::move(result_);
    }

private:
    Mesh& mesh() { return result_.mesh; }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(fmt::format("{}: {}", grid_.path.string(), what));
    }

    [[noreturn]] void fail_at_cell(const std::string& what) const { fail(fmt::format("cell {}: {}", cell_, what)); }

    void note(std::size_t count, const char* what)
    {
        if (count > 0)
            result_.notes.push_back(fmt::format("{} {}", count, what));
    }

    void join_points()
    {
        points_ =
            options_.weld ? join_all(grid_.points, options_.weld_tolerance) : join_pieces(grid_.points, grid_.pieces);
        joined_ = grid_.points.size() - points_.kept.size();
        if (joined_ == 0) {
            mesh().points = std::move(grid_.points);
            return;
        }
        mesh().points.reserve(points_.kept.size());
        for (const PointId point : points_.kept)
            mesh().points.push_back(grid_.points[point]);
    }

    void convert_cell()
    {
        const ListedCell& cell = grid_.cells[cell_];
        if (cell.hidden || cell.shape == ListedShape::empty) {
            ++hidden_;
            return;
        }
        if (cell.shape == ListedShape::lower) {
            ++lower_;
            return;
        }
        if (solids_ && is_surface(cell.shape)) {
            ++surface_cells_beside_solids_;
            return;
        }
        if (cell.shape == ListedShape::polyhedron)
            add_polyhedron();
        else
            add_cell_of_corners(cell.shape);
        higher_order_ += cell.higher_order ? 1 : 0;
        if (mesh().cell_count() > max_cells)
            fail(fmt::format("more than the {} cells that a mesh can have", max_cells));
        result_.file_cells.resize(mesh().cell_count(), cell_);
    }

    /// A point of the file by its number among those that are left.
    PointId point(std::int64_t id) const
    {
        if (id < 0 || static_cast<std::size_t>(id) >= points_.number.size())
            fail_at_cell(fmt::format("there is no point {}", id));
        const PointId number = points_.number[static_cast<std::size_t>(id)];
        const glm::dvec3& p = result_.mesh.points[number];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            fail_at_cell(fmt::format("coordinates of point {} are not finite", id));
        return number;
    }

    void add_cell_of_corners(ListedShape shape)
    {
        const auto listed = grid_.cell(cell_);
        const std::size_t wanted = corner_count(shape);
        if (wanted == 0 ? listed.size() < 3 : listed.size() != wanted)
            fail_at_cell(fmt::format("a {} with {} points", name(shape), listed.size()));
        corners_.clear();
        for (const std::int64_t id : listed)
            corners_.push_back(point(id));
        switch (shape) {
        case ListedShape::tetrahedron:
            mesh().add(CellShape::tetrahedron, corners_);
            break;
        case ListedShape::pyramid:
            mesh().add(CellShape::pyramid, corners_);
            break;
        case ListedShape::wedge:
            mesh().add(CellShape::wedge, corners_);
            break;
        case ListedShape::hexahedron:
            mesh().add(CellShape::hexahedron, corners_);
            break;
        case ListedShape::polygon:
            add_polygon();
            break;
        case ListedShape::strip:
            add_strip();
            break;
        case ListedShape::convex_hull:
            add_convex_hull();
            break;
        default:
            add_prism();
            break;
        }
    }

    void add_polygon()
    {
        constexpr std::size_t most_corners = 10000; // cutting it up takes the square of that
        if (corners_.size() > most_corners)
            fail_at_cell(fmt::format("a polygon of {} corners, more than {}", corners_.size(), most_corners));
        const auto triangles = triangles_of(corners_, mesh().points);
        if (triangles.size() > 1)
            ++split_;
        for (const auto& triangle : triangles)
            mesh().add(CellShape::triangle, triangle);
    }

    void add_strip()
    {
        ++split_;
        for (std::size_t i = 0; i + 2 < corners_.size(); ++i) {
            std::array triangle{corners_[i], corners_[i + 1], corners_[i + 2]};
            if (i % 2 == 1)
                std::swap(triangle[0], triangle[1]); // every other one runs the other way round
            mesh().add(CellShape::triangle, triangle);
        }
    }

    void add_prism()
    {
        faces_.clear();
        add_prism_faces(corners_, faces_);
        parts_.clear();
        cut_into_tetrahedra(faces_, parts_);
        add_parts();
    }

    void add_convex_hull()
    {
        if (corners_.size() > max_hull_points)
            fail_at_cell(
                fmt::format("a convex point set of {} points, more than {}", corners_.size(), max_hull_points));
        parts_.clear();
        cut_into_tetrahedra(convex_hull(corners_, mesh().points), parts_);
        if (parts_.empty())
            ++flat_;
        add_parts();
    }

    void add_polyhedron()
    {
        read_faces();
        if (!orient_faces(faces_))
            fail_at_cell("a polyhedron whose faces do not close");
        parts_.clear();
        cut_into_tetrahedra(faces_, parts_);
        double volume = 0;
        double least = 0;
        double greatest = 0;
        for (const TetrahedronCorners& part : parts_) {
            const double v = sixfold_volume(part, mesh().points);
            volume += v;
            least = std::min(least, v);
            greatest = std::max(greatest, v);
        }
        if (volume < 0)
            for (TetrahedronCorners& part : parts_)
                std::swap(part[2], part[3]);
        // Faces that are not quite planar bend the parts at them a little; a dent turns some inside out.
        constexpr double bent = 1e-3;
        if ((volume < 0 ? greatest : -least) > bent * std::abs(volume))
            fail_at_cell("a polyhedron that is not convex");
        add_parts();
    }

    void read_faces()
    {
        const auto listed = grid_.cell(cell_);
        faces_.clear();
        std::size_t at = 0;
        const auto next = [&] {
            if (at == listed.size())
                fail_at_cell("a polyhedron whose faces are cut short");
            return listed[at++];
        };
        for (std::int64_t faces = next(); faces > 0; --faces) {
            corners_.clear();
            for (std::int64_t count = next(); count > 0; --count)
                corners_.push_back(point(next()));
            faces_.add(corners_);
        }
    }

    void add_parts()
    {
        cut_ += parts_.empty() ? 0 : 1;
        for (const TetrahedronCorners& part : parts_)
            mesh().add(CellShape::tetrahedron, part);
    }

    void take(const FileArray& array)
    {
        result_.scalar = array.name;
        const std::vector<double> values = array.values();
        const std::size_t wanted = array.on_cells ? grid_.cells.size() : points_.number.size();
        if (values.size() != wanted)
            fail(fmt::format("scalar \"{}\" has {} values for {} {}", array.name, values.size(), wanted,
                             array.on_cells ? "cells" : "points"));
        std::vector<double> of_points(mesh().points.size(), missing);
        if (array.on_cells)
            average_to_points(values, of_points);
        else
            take_of_points(values, of_points);
        result_.scalar_map = scalar_map_of(of_points);
        mesh().scalars.resize(of_points.size());
        std::transform(of_points.begin(), of_points.end(), mesh().scalars.begin(),
                       [&](double value) { return static_cast<float>(result_.scalar_map.stored(value)); });
    }

    void take_of_points(const std::vector<double>& values, std::vector<double>& of_points) const
    {
        // Where points of several pieces became one, the first that has a value gives it.
        for (std::size_t i = points_.number.size(); i-- > 0;)
            if (!std::isnan(values[i]) || points_.kept[points_.number[i]] == i)
                if (double& scalar = of_points[points_.number[i]]; !std::isnan(values[i]) || std::isnan(scalar))
                    scalar = values[i];
    }

    /// A point's scalar is the mean over the file's cells at it that have a value.
    void average_to_points(const std::vector<double>& values, std::vector<double>& of_points) const
    {
        std::vector<double> sums(result_.mesh.points.size());
        std::vector<std::uint32_t> counts(result_.mesh.points.size());
        constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
        std::vector<std::uint64_t> last(result_.mesh.points.size(), none); // file cell that was counted last
        for (CellId cell = 0; cell < result_.mesh.cell_count(); ++cell) {
            const std::uint64_t file_cell = result_.file_cells[cell];
            if (std::isnan(values[file_cell]))
                continue;
            for (const PointId point : result_.mesh.cell(cell))
                if (last[point] != file_cell) {
                    last[point] = file_cell;
                    sums[point] += values[file_cell];
                    ++counts[point];
                }
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            if (counts[i] > 0)
                of_points[i] = sums[i] / counts[i];
    }

    void tell(const FileArray* array)
    {
        note(higher_order_, "cells of higher order taken by their corners");
        note(split_, "polygons split into triangles");
        note(cut_, "prisms, convex point sets and polyhedra cut into tetrahedra");
        note(flat_, "convex point sets without volume left out");
        note(surface_cells_beside_solids_, "surface cells beside the solids left out");
        note(lower_, "vertices and lines left out");
        note(hidden_, "hidden cells left out");
        if (array && array->components > 1)
            result_.notes.push_back(
                fmt::format("scalar \"{}\" is the magnitude of {} components", array->name, array->components));
        if (array && array->on_cells)
            result_.notes.push_back(fmt::format("scalar \"{}\" averaged from cells to points", array->name));
    }

    FileGrid grid_;
    const ReadOptions& options_;
    MeshFile result_;
    JoinedPoints points_;
    bool solids_ = false;
    std::size_t cell_ = 0; // the number in the file of the cell at hand
    std::vector<PointId> corners_;
    PolyhedronFaces faces_;
    std::vector<TetrahedronCorners> parts_;
    std::size_t joined_ = 0;
    std::size_t higher_order_ = 0;
    std::size_t split_ = 0;
    std::size_t cut_ = 0;
    std::size_t flat_ = 0;
    std::size_t surface_cells_beside_solids_ = 0;
    std::size_t lower_ = 0;
    std::size_t hidden_ = 0;
};

} // namespace

MeshFile mesh_of(FileGrid&& grid, const ReadOptions& options)
{
    return GridConversion(std::move(grid), options).run();
}

} // namespace visorder::detail
