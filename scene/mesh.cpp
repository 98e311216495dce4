#include "visorder/mesh.h"

#include "parallel/large_array.h"
#include "visorder/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <string>
#include <unordered_map>

namespace visorder {

using namespace detail;

namespace {

constexpr std::size_t max_cells = std::size_t{1} << 29;
constexpr std::size_t max_points = (std::size_t{1} << 32) - 1;

using Range = oneapi::tbb::blocked_range<std::size_t>;

/// What is wrong with cell i, or nothing. Reads within the arrays whatever they hold.
std::string fault_of_cell(const Mesh& mesh, std::size_t i)
{
    const CellShape shape = mesh.shapes[i];
    if (shape > CellShape::hexahedron)
        return fmt::format("unknown shape {}", static_cast<int>(shape));
    if ((shape == CellShape::triangle) != (mesh.shapes.front() == CellShape::triangle))
        return fmt::format("a {} in a mesh that began with a {}: triangles and solids do not mix", name(shape),
                           name(mesh.shapes.front()));

    const std::uint32_t begin = mesh.offsets[i];
    const std::uint32_t end = mesh.offsets[i + 1];
    if (end < begin)
        return fmt::format("offsets fall from {} to {}", begin, end);
    if (end - begin != static_cast<std::uint32_t>(vertex_count(shape)))
        return fmt::format("a {} has {} vertices, not {}", name(shape), vertex_count(shape), end - begin);
    if (end > mesh.vertices.size())
        return fmt::format("offset {} is beyond the {} vertices", end, mesh.vertices.size());

    for (const PointId point : mesh.cell(static_cast<CellId>(i)))
        if (point >= mesh.points.size())
            return fmt::format("point {} is out of range, there are {}", point, mesh.points.size());
    return {};
}

std::string fault_of_point(const Mesh& mesh, std::size_t i)
{
    const glm::dvec3& p = mesh.points[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
        return {};
    return fmt::format("point {}: coordinates ({}, {}, {}) are not finite", i, p.x, p.y, p.z);
}

/// Throws the fault of the lowest of `count` items that has one, however the work is spread over threads.
template <class FaultOf, class Throw>
void throw_first_fault(std::size_t count, const FaultOf& fault_of, const Throw& throw_fault)
{
    const std::size_t first = oneapi::tbb::parallel_reduce(
        Range(0, count, 4096), count,
        [&](const Range& range, std::size_t lowest) {
            for (std::size_t i = range.begin(); i < std::min(range.end(), lowest); ++i)
                if (!fault_of(i).empty())
                    return i;
            return lowest;
        },
        [](std::size_t a, std::size_t b) { return std::min(a, b); });
    if (first < count)
        throw_fault(first, fault_of(first));
}

void check_point_arrays(const Mesh& mesh)
{
    if (mesh.points.size() > max_points)
        throw InputError(
            fmt::format("{} points are more than the {} that a mesh can have", mesh.points.size(), max_points));
    if (!mesh.scalars.empty() && mesh.scalars.size() != mesh.points.size())
        throw InputError(fmt::format("{} scalars do not fit {} points", mesh.scalars.size(), mesh.points.size()));
}

/// A hash of coordinates that is the same for 0.0 and -0.0.
std::uint64_t hash(const glm::dvec3& p)
{
    std::uint64_t h = 0;
    for (const double x : {p.x, p.y, p.z}) {
        h = (h ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15u; // -0.0 + 0.0 is 0.0
        h ^= h >> 32;
    }
    return h;
}

/// For each point the lowest point with the same coordinates.
LargeArray<PointId> lowest_equal_points(const std::vector<glm::dvec3>& points)
{
    // An open-addressing table of points. Half the hash is kept beside each, so that coordinates are read almost only
    // to confirm that two points are equal.
    struct Entry {
        PointId point;
        std::uint32_t tag;
    };
    constexpr PointId none = ~PointId{0};
    const std::size_t mask = std::bit_ceil(2 * points.size() + 1) - 1;
    LargeArray<Entry> table(mask + 1, Entry{none, 0});

    LargeArray<PointId> lowest(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint64_t h = hash(points[i]);
        const auto tag = static_cast<std::uint32_t>(h >> 32);
        lowest[i] = static_cast<PointId>(i);
        for (std::size_t slot = h & mask;; slot = (slot + 1) & mask) {
            Entry& entry = table[slot];
            if (entry.point == none) {
                entry = {static_cast<PointId>(i), tag};
                break;
            }
            if (entry.tag == tag && points[entry.point] == points[i]) {
                lowest[i] = entry.point;
                break;
            }
        }
    }
    return lowest;
}

// For each point the first one kept that lies within the tolerance, or itself, which is then kept.
LargeArray<PointId> first_near_points(const std::vector<glm::dvec3>& points, double tolerance)
{
    // Points kept, by the cubes of a grid. Whatever is within the tolerance lies in the same cube or one beside it. The
    // numbers of cubes are doubles: far away, where they are no longer apart, a cube is tried more than once.
    std::unordered_map<std::uint64_t, std::vector<PointId>> kept;
    const auto cube_of = [&](const glm::dvec3& p) { return glm::floor(p / tolerance); };
    LargeArray<PointId> first(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 cube = cube_of(points[i]);
        PointId found = static_cast<PointId>(i);
        for (int beside = 0; beside < 27; ++beside) {
            const glm::dvec3 offset(beside % 3 - 1, beside / 3 % 3 - 1, beside / 9 - 1);
            const auto at = kept.find(hash(cube + offset));
            if (at == kept.end())
                continue;
            for (const PointId candidate : at->second)
                if (candidate < found && glm::distance(points[candidate], points[i]) <= tolerance)
                    found = candidate;
        }
        first[i] = found;
        if (found == i)
            kept[hash(cube)].push_back(found);
    }
    return first;
}

// Joins each point with the one that `renumbered` has for it, which comes no later and is kept. Returns how many went.
std::size_t join(Mesh& mesh, LargeArray<PointId> renumbered)
{
    // In ascending order the point that a set keeps has been renumbered before the others of the set look it up.
    const std::size_t before = mesh.points.size();
    PointId kept = 0;
    for (std::size_t i = 0; i < before; ++i) {
        if (renumbered[i] != i) {
            renumbered[i] = renumbered[renumbered[i]];
            continue;
        }
        mesh.points[kept] = mesh.points[i];
        if (!mesh.scalars.empty())
            mesh.scalars[kept] = mesh.scalars[i];
        renumbered[i] = kept++;
    }
    mesh.points.resize(kept);
    if (!mesh.scalars.empty())
        mesh.scalars.resize(kept);

    oneapi::tbb::parallel_for(Range(0, mesh.vertices.size(), 4096), [&](const Range& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            // An index out of range stays out of range, for `validate` to name.
            if (mesh.vertices[i] < before)
                mesh.vertices[i] = renumbered[mesh.vertices[i]];
    });
    return before - kept;
}

} // namespace

void Mesh::add(CellShape shape, std::span<const std::uint32_t> cell_vertices)
{
    if (offsets.empty())
        offsets.push_back(0);
    shapes.push_back(shape);
    vertices.insert(vertices.end(), cell_vertices.begin(), cell_vertices.end());
    offsets.push_back(static_cast<std::uint32_t>(vertices.size()));
}

void validate(const Mesh& mesh)
{
    const std::size_t cells = mesh.cell_count();
    if (cells == 0)
        throw InputError("the mesh has no cells");
    if (cells > max_cells)
        throw InputError(fmt::format("{} cells are more than the {} that a mesh can have", cells, max_cells));
    if (mesh.offsets.size() != cells + 1)
        throw InputError(
            fmt::format("{} offsets do not fit {} cells, which take {}", mesh.offsets.size(), cells, cells + 1));
    if (mesh.offsets.front() != 0)
        throw InputError(fmt::format("cell 0: the first offset is {}, not 0", mesh.offsets.front()));
    check_point_arrays(mesh);
    throw_first_fault(
        cells, [&](std::size_t i) { return fault_of_cell(mesh, i); },
        [](std::size_t i, const std::string& fault) { throw CellError(i, fault); });
    if (mesh.offsets.back() != mesh.vertices.size())
        throw CellError(cells - 1, fmt::format("the last offset is {}, but there are {} vertices", mesh.offsets.back(),
                                               mesh.vertices.size()));
    throw_first_fault(
        mesh.points.size(), [&](std::size_t i) { return fault_of_point(mesh, i); },
        [](std::size_t, const std::string& fault) { throw InputError(fault); });
}

std::size_t weld(Mesh& mesh)
{
    check_point_arrays(mesh);
    return join(mesh, lowest_equal_points(mesh.points));
}

std::size_t weld(Mesh& mesh, double tolerance)
{
    if (!(tolerance >= 0 && std::isfinite(tolerance)))
        throw InputError(fmt::format("points cannot be joined within a distance of {}", tolerance));
    const std::size_t equal = weld(mesh);
    return tolerance > 0 ? equal + join(mesh, first_near_points(mesh.points, tolerance)) : equal;
}

} // namespace visorder
