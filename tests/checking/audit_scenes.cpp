#include "audit_scenes.h"

#include "geometry/exact_predicates.h"
#include "scene/face_loop.h"
#include "scene/overlapping_cells.h"
#include "small_scenes.h"
#include "visorder/box.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace visorder::tests {

using namespace detail;

namespace {

// Coordinates of the scenes are small integers, so that means of four points, and points in planes, are exact. What
// moves a scene off the integers comes last and moves the eyes along.

glm::dvec3 point_of(const Mesh& mesh, CellId cell, std::size_t vertex)
{
    return mesh.points[mesh.cell(cell)[vertex]];
}

CellId any_cell(const Mesh& mesh, Random& random)
{
    return static_cast<CellId>(random.below(static_cast<int>(mesh.cell_count())));
}

// The vertices of one face of a cell, some of them twice if it has three: four in all.
std::array<glm::dvec3, 4> any_face(const Mesh& mesh, CellId cell, Random& random)
{
    const auto v = mesh.cell(cell);
    std::array<glm::dvec3, 4> corners;
    if (mesh.shapes[cell] == CellShape::triangle) {
        for (std::size_t i = 0; i < 4; ++i)
            corners[i] = mesh.points[v[i % 3]];
        return corners;
    }
    const auto face = face_vertices(mesh.shapes[cell], random.below(face_count(mesh.shapes[cell])));
    for (std::size_t i = 0; i < 4; ++i)
        corners[i] = mesh.points[v[face[i % face.size()]]];
    return corners;
}

Box box_of(const Mesh& mesh)
{
    Box box;
    for (const glm::dvec3& p : mesh.points)
        box.add(p);
    return box;
}

std::vector<glm::dvec4> degenerate_eyes(const Mesh& mesh, Random& random)
{
    const Box box = box_of(mesh);
    const double size = std::max(1.0, glm::length(box.max - box.min));
    std::vector<glm::dvec4> eyes;
    const auto at = [&](const glm::dvec3& p) { eyes.emplace_back(p, 1); };
    const auto along = [&](const glm::dvec3& d) {
        if (d != glm::dvec3(0))
            eyes.emplace_back(d, 0);
    };
    at(mesh.points[static_cast<std::size_t>(random.below(static_cast<int>(mesh.points.size())))]);
    for (int i = 0; i < 2; ++i) {
        const auto f = any_face(mesh, any_cell(mesh, random), random);
        at((f[0] + f[1] + f[2] + f[3]) * 0.25); // on a face, or its edge
        const double a = random.from_to(-3, 3), b = random.from_to(-9, 9);
        at(f[0] + (f[1] - f[0]) * a + (f[2] - f[0]) * b); // in its plane
        along((f[1] - f[0]) * (1.0 * random.from_to(-3, 3)) + (f[2] - f[0]));
    }
    {
        const CellId cell = any_cell(mesh, random);
        const std::size_t last = mesh.cell(cell).size() - 1;
        // Inside, or on a face of, a cell; and in line with one of its edges.
        at((point_of(mesh, cell, 0) + point_of(mesh, cell, 1) + point_of(mesh, cell, 2) + point_of(mesh, cell, last)) *
           0.25);
        at(point_of(mesh, cell, 0) * 3.0 - point_of(mesh, cell, 1) * 2.0);
        along(point_of(mesh, cell, 0) - point_of(mesh, cell, last));
    }
    const auto corner = [&] {
        const int which = random.below(8);
        return glm::dvec3((which & 1) != 0 ? box.max.x : box.min.x, (which & 2) != 0 ? box.max.y : box.min.y,
                          (which & 4) != 0 ? box.max.z : box.min.z);
    };
    // Calls in the arguments of one call have no order that holds on every machine.
    const auto real_point = [&] {
        const double x = random.real(), y = random.real(), z = random.real();
        return glm::dvec3(x, y, z) - 0.5;
    };
    at(corner());
    at(box.max + glm::dvec3(1e-12 * size));
    at(corner() + (1e-12 * size) * random.integer_point(-3, 3));
    at(box.middle() + 1e9 * size * random.integer_point(-5, 5));
    // Of huge scenes no integers are near the bounds.
    const auto integer = [](double x) { return static_cast<int>(std::clamp(x, -1e6, 1e6)); };
    const int low = integer(std::min({box.min.x, box.min.y, box.min.z}));
    const int high = integer(std::max({box.max.x, box.max.y, box.max.z}));
    at(random.integer_point(low, high));
    at(random.integer_point(low - 2, high + 2));
    at(random.integer_point(low - 50, high + 50));
    // In the planes of a grid, if there is one.
    at({random.from_to(low, high) * 1.0, random.from_to(low, high) * 1.0, high + 7.0});
    eyes.emplace_back(random.integer_point(3 * low - 9, 3 * high + 9), 3); // a third of that
    glm::dvec3 axis(0);
    axis[random.below(3)] = random.below(2) == 0 ? 1 : -1;
    along(axis);
    along(random.integer_point(-1, 1));
    along(random.integer_point(-9, 9));
    along(real_point());
    at(box.middle() + 2 * size * real_point());
    return eyes;
}

AuditScene with_eyes(Mesh mesh, Random& random)
{
    AuditScene scene{std::move(mesh), {}};
    scene.eyes = degenerate_eyes(scene.mesh, random);
    return scene;
}

bool any_overlap(const Mesh& mesh)
{
    return !Scene(mesh).overlapping_cells().empty();
}

// The same solid with its vertices in the reverse of VTK's order.
void invert(Mesh& mesh, CellId cell)
{
    PointId* v = mesh.vertices.data() + mesh.offsets[cell];
    switch (mesh.shapes[cell]) {
    case CellShape::triangle:
        std::swap(v[1], v[2]);
        break;
    case CellShape::tetrahedron:
        std::swap(v[0], v[1]);
        break;
    case CellShape::pyramid:
        std::swap(v[1], v[3]);
        break;
    case CellShape::wedge:
        for (int i = 0; i < 3; ++i)
            std::swap(v[i], v[i + 3]);
        break;
    case CellShape::hexahedron:
        for (int i = 0; i < 4; ++i)
            std::swap(v[i], v[i + 4]);
    }
}

// One of the scenes without overlaps that have whole cells or tetrahedra.
Mesh sound_scene(std::uint64_t number, Random& random)
{
    const Mesh mesh = small_scene(number);
    return random.below(3) == 0 ? subdivide(mesh).mesh : mesh;
}

// Tetrahedra with corners on a small grid that overlap none before, and cells without volume among them.
Mesh tetrahedra_on_a_grid(int attempts, int size, double flat, Random& random)
{
    Mesh mesh;
    for (int x = 0; x <= size; ++x)
        for (int y = 0; y <= size; ++y)
            for (int z = 0; z <= size; ++z)
                mesh.points.emplace_back(x, y, z);
    const auto count = static_cast<int>(mesh.points.size());
    for (int i = 0; i < attempts; ++i) {
        std::array<PointId, 4> v;
        const bool to_be_flat = random.real() < flat;
        int tries = 0;
        bool fits = false;
        do {
            for (PointId& p : v)
                p = static_cast<PointId>(random.below(count));
            const bool is_flat =
                side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]) == Sign::zero;
            fits = is_flat == to_be_flat;
        } while (!fits && ++tries < 50);
        Mesh more = mesh;
        more.add(CellShape::tetrahedron, v);
        // Three cells at one face make no mesh.
        try {
            const Scene scene(more);
            if (scene.overlapping_cells().empty())
                mesh = std::move(more);
        } catch (const std::exception&) {
            continue;
        }
    }
    if (mesh.cell_count() == 0)
        mesh.add(CellShape::tetrahedron,
                 std::array{0u, 1u, static_cast<PointId>(size + 1), static_cast<PointId>(count - 1)});
    return mesh;
}

AuditScene flat_cells_among_solids(std::uint64_t number)
{
    Random random(number);
    if (number % 4 == 0) {
        Mesh mesh = squashed_delaunay(number);
        return with_eyes(std::move(mesh), random);
    }
    const int attempts = 8 + random.below(10), size = 1 + random.below(3);
    return with_eyes(tetrahedra_on_a_grid(attempts, size, 0.4, random), random);
}

AuditScene tetrahedra_in_contact(std::uint64_t number)
{
    Random random(number);
    const int attempts = 10 + random.below(14), size = 2 + random.below(3);
    return with_eyes(tetrahedra_on_a_grid(attempts, size, 0, random), random);
}

// Some points of some cells moved by one unit in the last place: what touched may overlap by that or part.
Mesh nudged(Mesh mesh, int nudges, Random& random)
{
    for (int i = 0; i < nudges; ++i) {
        const CellId cell = any_cell(mesh, random);
        const auto v = mesh.cell(cell);
        PointId& vertex =
            mesh.vertices[mesh.offsets[cell] + static_cast<std::size_t>(random.below(static_cast<int>(v.size())))];
        glm::dvec3 p = mesh.points[vertex];
        double& x = p[random.below(3)];
        x = std::nextafter(x, random.below(2) == 0 ? -1e300 : 1e300);
        if (random.below(3) == 0) {
            mesh.points[vertex] = p; // of all its cells
        } else {
            mesh.points.push_back(p);
            vertex = static_cast<PointId>(mesh.points.size() - 1);
        }
    }
    return mesh;
}

AuditScene overlaps_by_one_ulp(std::uint64_t number)
{
    Random random(number);
    // A stack whose sides stay planar when a whole face of it moves; or tetrahedra, which any points make.
    if (number % 3 == 0) {
        Mesh mesh;
        const int count = 3 + random.below(7);
        for (int i = 0; i < count; ++i) {
            double low = 1.0 + i, high = 2.0 + i;
            if (random.below(3) == 0)
                low = std::nextafter(low, random.below(2) == 0 ? 0 : 100);
            if (random.below(3) == 0)
                high = std::nextafter(high, random.below(2) == 0 ? 0 : 100);
            const glm::dvec3 aside{random.below(2) * 1.0, random.below(2) * 1.0, 0.0};
            add_box(mesh, aside + glm::dvec3(0, 0, low), aside + glm::dvec3(2, 2, high));
        }
        weld(mesh);
        return with_eyes(std::move(mesh), random);
    }
    Mesh mesh = subdivide(small_scene(number)).mesh;
    for (glm::dvec3& p : mesh.points)
        p += glm::dvec3(1);
    const int nudges = 1 + random.below(4);
    return with_eyes(nudged(std::move(mesh), nudges, random), random);
}

// Boxes of a binary octree: each is whole, tetrahedra, wedges or pyramids, or eight smaller ones, or missing.
void add_octree(Mesh& mesh, const glm::dvec3& origin, int size, Random& random)
{
    const auto corner = [&](int x, int y, int z) {
        const glm::dvec3 p = origin + glm::dvec3(x, y, z);
        const auto found = std::find(mesh.points.begin(), mesh.points.end(), p);
        if (found != mesh.points.end())
            return static_cast<PointId>(found - mesh.points.begin());
        mesh.points.push_back(p);
        return static_cast<PointId>(mesh.points.size() - 1);
    };
    const int what = random.below(10);
    if (size > 1 && what < 5) {
        for (int i = 0; i < 8; ++i)
            add_octree(mesh, origin + (size / 2.0) * glm::dvec3(i & 1, i >> 1 & 1, i >> 2), size / 2, random);
        return;
    }
    if (what == 9)
        return;
    const std::array v{corner(0, 0, 0),    corner(size, 0, 0),    corner(size, size, 0),    corner(0, size, 0),
                       corner(0, 0, size), corner(size, 0, size), corner(size, size, size), corner(0, size, size)};
    if (random.below(2) == 0) {
        mesh.add(CellShape::hexahedron, v);
    } else {
        mesh.add(CellShape::wedge, std::array{v[0], v[3], v[1], v[4], v[7], v[5]});
        mesh.add(CellShape::wedge, std::array{v[1], v[3], v[2], v[5], v[7], v[6]});
    }
}

AuditScene hanging_nodes(std::uint64_t number)
{
    Random random(number);
    Mesh mesh;
    while (mesh.cell_count() == 0)
        add_octree(mesh, glm::dvec3(0), 4, random);
    if (mesh.cell_count() > 60) {
        // The first ones of it.
        mesh.shapes.resize(60);
        mesh.offsets.resize(61);
        mesh.vertices.resize(mesh.offsets.back());
    }
    return with_eyes(random.below(3) == 0 ? subdivide(mesh).mesh : mesh, random);
}

AuditScene cells_in_contact(std::uint64_t number)
{
    Random random(number);
    const Mesh mesh = scattered_cells(40, 3 + static_cast<int>(number % 4), number);
    return with_eyes(random.below(3) == 0 ? subdivide(mesh).mesh : mesh, random);
}

// Bars that pass over and under each other, and other cells around them, which relations run through.
AuditScene bars(std::uint64_t number)
{
    Random random(number);
    Mesh mesh = interlocked_bars(true);
    if (random.below(2) == 0) {
        const Mesh more = interlocked_bars(true);
        glm::dvec3 aside = random.integer_point(-9, 9);
        aside.z += random.below(2) == 0 ? 30 : 50;
        for (CellId cell = 0; cell < more.cell_count(); ++cell) {
            std::array<glm::dvec3, 8> corners;
            for (std::size_t i = 0; i < 8; ++i)
                corners[i] = point_of(more, cell, i) + aside;
            add_box(mesh, corners);
        }
    }
    for (int i = 0; i < 12; ++i) {
        Mesh more = mesh;
        add_random_cell(more, random, -14, 30);
        if (!any_overlap(more))
            mesh = std::move(more);
    }
    AuditScene scene = with_eyes(random.below(2) == 0 ? subdivide(mesh).mesh : mesh, random);
    // Whence the bars run in a circle.
    scene.eyes.emplace_back(0, 0, 1, 0);
    scene.eyes.emplace_back(0, 0, -60, 1);
    const int x = random.from_to(-3, 3), y = random.from_to(-3, 3);
    scene.eyes.emplace_back(x, y, 100, 1);
    return scene;
}

AuditScene cavities(std::uint64_t number)
{
    Random random(number);
    Mesh mesh;
    const int middle = 1 + random.below(2), size = 3;
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            for (int z = 0; z < size; ++z)
                if ((x != 1 || y != 1 || (z != 1 && z != middle)) && random.below(12) != 0)
                    add_box(mesh, 4.0 * glm::dvec3(x, y, z), 4.0 * glm::dvec3(x + 1, y + 1, z + 1));
    weld(mesh);
    for (int i = 0; i < 3; ++i) {
        Mesh more = mesh;
        add_random_cell(more, random, 4, 8);
        if (!any_overlap(more))
            mesh = std::move(more);
    }
    return with_eyes(random.below(3) == 0 ? subdivide(mesh).mesh : mesh, random);
}

AuditScene surfaces(std::uint64_t number)
{
    Random random(number);
    if (number % 3 == 0) {
        const int count = 6 + random.below(12), size = 4 + random.below(30);
        return with_eyes(random_triangles(count, size, number), random);
    }
    if (number % 3 == 1) {
        // Faces of solids that do not overlap: they touch and coincide, but do not cross.
        const Mesh solids = small_scene(number);
        std::vector<glm::dvec3> corners;
        for (CellId cell = 0; cell < solids.cell_count(); ++cell) {
            const auto f = any_face(solids, cell, random);
            corners.insert(corners.end(), {f[0], f[1], f[2]});
        }
        return with_eyes(triangles(corners), random);
    }
    // On a small grid, with corners in common.
    std::vector<glm::dvec3> corners;
    const int size = 1 + random.below(3);
    for (int i = 0; i < 3 * (6 + random.below(12)); ++i)
        corners.push_back(random.integer_point(0, size));
    Mesh mesh = triangles(corners);
    weld(mesh);
    return with_eyes(std::move(mesh), random);
}

AuditScene mixed_cells(std::uint64_t number)
{
    Random random(number);
    const int x = 2 + random.below(2), z = 1 + random.below(2), spacing = 1 + random.below(3);
    return with_eyes(box_grid({x, 2, z}, spacing, 0.3, number), random);
}

AuditScene inverted_cells(std::uint64_t number)
{
    Random random(number);
    Mesh mesh = sound_scene(number, random);
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        if (random.below(2) == 0)
            invert(mesh, cell);
    return with_eyes(std::move(mesh), random);
}

AuditScene duplicated_points(std::uint64_t number)
{
    Random random(number);
    Mesh mesh = sound_scene(number, random);
    const bool all = random.below(3) == 0;
    for (PointId& v : mesh.vertices)
        if (all || random.below(4) == 0) {
            mesh.points.push_back(mesh.points[v]);
            v = static_cast<PointId>(mesh.points.size() - 1);
        }
    return with_eyes(std::move(mesh), random);
}

AuditScene repeated_vertices(std::uint64_t number)
{
    Random random(number);
    Mesh mesh = small_scene(number);
    // A pyramid as a hexahedron whose upper corners are one point, a tetrahedron as a wedge, and cells that collapse.
    Mesh result;
    result.points = mesh.points;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto v = mesh.cell(cell);
        switch (mesh.shapes[cell]) {
        case CellShape::pyramid:
            result.add(CellShape::hexahedron, std::array{v[0], v[1], v[2], v[3], v[4], v[4], v[4], v[4]});
            break;
        case CellShape::wedge:
            result.add(CellShape::hexahedron, std::array{v[0], v[2], v[1], v[1], v[3], v[5], v[4], v[4]});
            break;
        case CellShape::tetrahedron:
            if (random.below(2) == 0)
                result.add(CellShape::wedge, std::array{v[0], v[2], v[1], v[3], v[3], v[3]});
            else
                result.add(CellShape::pyramid, std::array{v[0], v[1], v[2], v[2], v[3]});
            break;
        default:
            result.add(mesh.shapes[cell], v);
        }
        if (random.below(8) == 0)
            result.add(CellShape::tetrahedron, std::array{v[0], v[1], v[1], v[2]});
    }
    return with_eyes(std::move(result), random);
}

AuditScene general_position(std::uint64_t number)
{
    Random random(number);
    Mesh mesh = number % 2 == 0 ? carved_delaunay(8, 40, 0.6, number) : tetrahedra_on_a_grid(14, 3, 0.1, random);
    // Flat cells get volume, and what overlaps by that is as good a scene.
    for (glm::dvec3& p : mesh.points)
        for (int c = 0; c < 3; ++c)
            p[c] += 1e-9 * random.real();
    return with_eyes(std::move(mesh), random);
}

void scale(AuditScene& scene, const glm::dvec3& factor)
{
    for (glm::dvec3& p : scene.mesh.points)
        p *= factor;
    for (glm::dvec4& eye : scene.eyes)
        eye *= glm::dvec4(factor, 1);
}

// By powers of two that keep the integers exact, down to subnormal ones; alike along each axis or not.
AuditScene magnitudes(std::uint64_t number)
{
    Random random(number);
    const auto kinds = audit_kinds();
    const AuditKind& kind = kinds[number % (kinds.size() - 1)];
    AuditScene scene = kind.scene(number);
    const auto power = [&] {
        switch (random.below(6)) {
        case 0:
            return -1073;
        case 1:
            return random.from_to(-1073, -1000);
        case 2:
            return random.from_to(900, 990);
        default:
            return random.from_to(-1000, 900);
        }
    };
    glm::dvec3 factor(std::ldexp(1.0, power()));
    // Cells with planar faces keep them when axes are scaled apart.
    for (int axis = 0; axis < 3 && number % 4 == 0; ++axis)
        factor[axis] = std::ldexp(1.0, power());
    scale(scene, factor);
    std::erase_if(scene.eyes, [](const glm::dvec4& eye) {
        return !std::isfinite(eye.x) || !std::isfinite(eye.y) || !std::isfinite(eye.z) || eye == glm::dvec4(0);
    });
    return scene;
}

// Scenes of all other kinds, far from the origin, and eyes with weights of any size.
AuditScene far_from_the_origin(std::uint64_t number)
{
    Random random(number);
    Mesh mesh = sound_scene(number, random);
    const double unit = std::ldexp(1.0, random.from_to(10, 44));
    const glm::dvec3 offset = unit * random.integer_point(-3, 3);
    for (glm::dvec3& p : mesh.points)
        p += offset;
    AuditScene scene = with_eyes(std::move(mesh), random);
    for (glm::dvec4& eye : scene.eyes)
        if (random.below(2) == 0)
            eye *= (random.below(4) == 0 ? -1.0 : 1.0);
    for (glm::dvec4& eye : scene.eyes)
        if (random.below(2) == 0)
            eye *= std::ldexp(1.0, random.from_to(-700, 700));
    return scene;
}

constexpr std::array kinds{
    AuditKind{"ulp", "overlaps and gaps of one unit in the last place", overlaps_by_one_ulp},
    AuditKind{"flat", "tetrahedra without volume among solid ones", flat_cells_among_solids},
    AuditKind{"hanging", "boxes of a binary octree, faces of different sizes meeting", hanging_nodes},
    AuditKind{"contact", "cells of all shapes that touch anyhow", cells_in_contact},
    AuditKind{"tetrahedra", "tetrahedra that touch anyhow", tetrahedra_in_contact},
    AuditKind{"bars", "bars that occlude each other in a cycle, and cells around them", bars},
    AuditKind{"cavities", "boxes around a hole with cells in it", cavities},
    AuditKind{"surfaces", "triangles that cross, touch and coincide", surfaces},
    AuditKind{"mixed", "hexahedra, wedges and pyramids in a grid", mixed_cells},
    AuditKind{"inverted", "cells whose vertices stand in the reverse order", inverted_cells},
    AuditKind{"duplicated", "points that stand in the mesh more than once", duplicated_points},
    AuditKind{"repeated", "cells that name a vertex more than once", repeated_vertices},
    AuditKind{"general", "coordinates that are no integers", general_position},
    AuditKind{"far", "far from the origin, and eyes of any weight", far_from_the_origin},
    AuditKind{"magnitudes", "any of these, from subnormal coordinates to 1e300", magnitudes},
};

int vtk_type(CellShape shape)
{
    switch (shape) {
    case CellShape::triangle:
        return 5;
    case CellShape::tetrahedron:
        return 10;
    case CellShape::pyramid:
        return 14;
    case CellShape::wedge:
        return 13;
    case CellShape::hexahedron:
        return 12;
    }
    return 0;
}

} // namespace

std::span<const AuditKind> audit_kinds()
{
    return kinds;
}

std::string vtk_text(const Mesh& mesh, const std::string& title)
{
    std::string text =
        fmt::format("# vtk DataFile Version 3.0\n{}\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n", title,
                    mesh.points.size());
    for (const glm::dvec3& p : mesh.points)
        text += fmt::format("{:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
    text += fmt::format("CELLS {} {}\n", mesh.cell_count(), mesh.cell_count() + mesh.vertices.size());
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        text += fmt::format("{}", mesh.cell(cell).size());
        for (PointId v : mesh.cell(cell))
            text += fmt::format(" {}", v);
        text += '\n';
    }
    text += fmt::format("CELL_TYPES {}\n", mesh.cell_count());
    for (CellShape shape : mesh.shapes)
        text += fmt::format("{}\n", vtk_type(shape));
    return text;
}

} // namespace visorder::tests
