#include "small_scenes.h"

#include "brute_force.h"
#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/face_loop.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numeric>

namespace visorder::tests {

using namespace detail;

namespace {

std::uint32_t add_point(Mesh& mesh, const glm::dvec3& point)
{
    mesh.points.push_back(point);
    return static_cast<std::uint32_t>(mesh.points.size() - 1);
}

/// The point's index, the same for equal points.
std::uint32_t shared_point(Mesh& mesh, const glm::dvec3& point)
{
    const auto found = std::find(mesh.points.begin(), mesh.points.end(), point);
    if (found != mesh.points.end())
        return static_cast<std::uint32_t>(found - mesh.points.begin());
    return add_point(mesh, point);
}

Sign side(const Mesh& mesh, const std::array<PointId, 4>& v)
{
    return side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]);
}

// The corners of a box as VTK numbers them, taken to space by an affine map.
std::array<glm::dvec3, 8> parallelepiped(const glm::dvec3& origin, const glm::dvec3& x, const glm::dvec3& y,
                                         const glm::dvec3& z)
{
    return {origin,     origin + x,     origin + x + y,     origin + y,
            origin + z, origin + x + z, origin + x + y + z, origin + y + z};
}

// Of the kinds: whole, whole, wedges, pyramids.
Mesh boxes_of_kinds(glm::ivec3 boxes, int spacing, double missing, std::uint64_t seed, int kinds)
{
    Random random(seed);
    Mesh mesh;
    for (int i = 0; i < boxes.x; ++i)
        for (int j = 0; j < boxes.y; ++j)
            for (int k = 0; k < boxes.z; ++k) {
                if (random.real() < missing)
                    continue;
                const glm::dvec3 origin(i * spacing, j * spacing, k * spacing);
                std::array<std::uint32_t, 8> v;
                const auto corners = parallelepiped(origin, {spacing, 0, 0}, {0, spacing, 0}, {0, 0, spacing});
                std::transform(corners.begin(), corners.end(), v.begin(),
                               [&](const glm::dvec3& p) { return shared_point(mesh, p); });
                const int kind = random.below(kinds);
                if (kind < 2) {
                    mesh.add(CellShape::hexahedron, v);
                } else if (kind == 2) {
                    mesh.add(CellShape::wedge, std::array{v[0], v[3], v[1], v[4], v[7], v[5]});
                    mesh.add(CellShape::wedge, std::array{v[1], v[3], v[2], v[5], v[7], v[6]});
                } else {
                    const std::uint32_t middle = shared_point(mesh, origin + glm::dvec3(spacing / 2));
                    for (int face = 0; face < 6; ++face) {
                        const auto f = face_vertices(CellShape::hexahedron, face);
                        mesh.add(CellShape::pyramid, std::array{v[f[0]], v[f[1]], v[f[2]], v[f[3]], middle});
                    }
                }
            }
    return mesh.cell_count() > 0 ? mesh : boxes_of_kinds(boxes, spacing, 0, seed, kinds);
}

} // namespace

Mesh carved_delaunay(int points, int size, double keep, std::uint64_t seed)
{
    Random random(seed);
    Mesh mesh;
    // A point on a sphere through four others would leave the tetrahedralisation open; it is drawn again.
    const auto general = [&](const glm::dvec3& p) {
        const auto n = static_cast<PointId>(mesh.points.size());
        for (PointId a = 0; a < n; ++a)
            for (PointId b = a + 1; b < n; ++b)
                for (PointId c = b + 1; c < n; ++c) {
                    if (side_of_plane(mesh.points[a], mesh.points[b], mesh.points[c], p) == Sign::zero)
                        return false;
                    for (PointId d = c + 1; d < n; ++d)
                        if (in_circumsphere(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d], p) ==
                            Sign::zero)
                            return false;
                }
        return true;
    };
    while (static_cast<int>(mesh.points.size()) < points) {
        const glm::dvec3 p = random.integer_point(0, size);
        if (std::find(mesh.points.begin(), mesh.points.end(), p) == mesh.points.end() && general(p))
            mesh.points.push_back(p);
    }
    const auto n = static_cast<PointId>(points);
    for (PointId a = 0; a < n; ++a)
        for (PointId b = a + 1; b < n; ++b)
            for (PointId c = b + 1; c < n; ++c)
                for (PointId d = c + 1; d < n; ++d) {
                    std::array<PointId, 4> v{a, b, c, d};
                    if (side(mesh, v) == Sign::positive)
                        std::swap(v[1], v[2]);
                    bool empty = true;
                    for (PointId e = 0; e < n && empty; ++e)
                        empty = e == a || e == b || e == c || e == d ||
                                in_circumsphere(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]],
                                                mesh.points[v[3]], mesh.points[e]) != Sign::positive;
                    if (!empty || random.real() >= keep)
                        continue;
                    // Some cells inverted: the same solids.
                    if (random.below(4) == 0)
                        std::swap(v[0], v[3]);
                    mesh.add(CellShape::tetrahedron, v);
                }
    if (mesh.cell_count() == 0)
        return carved_delaunay(points, size, keep, seed + 1000);
    return mesh;
}

Mesh box_grid(glm::ivec3 boxes, int spacing, double missing, std::uint64_t seed)
{
    return boxes_of_kinds(boxes, spacing, missing, seed, spacing % 2 == 0 ? 4 : 3);
}

Mesh whole_boxes(glm::ivec3 boxes, int spacing, double missing, std::uint64_t seed)
{
    return boxes_of_kinds(boxes, spacing, missing, seed, 1);
}

void add_random_cell(Mesh& mesh, Random& random, int low, int high)
{
    const auto inside = [&](const glm::dvec3& p) {
        return p.x >= low && p.y >= low && p.z >= low && p.x <= high && p.y <= high && p.z <= high;
    };
    while (true) {
        const int reach = std::max(1, (high - low) / 2);
        const glm::dvec3 origin = random.integer_point(low, high);
        const glm::dvec3 x = random.integer_point(-reach, reach), y = random.integer_point(-reach, reach),
                         z = random.integer_point(-reach, reach);
        if (glm::dot(glm::cross(x, y), z) == 0)
            continue;
        const auto box = parallelepiped(origin, x, y, z);
        // The shapes are the parallelepiped or parts of it; frusta for some of the pyramids and wedges come by halving.
        std::vector<glm::dvec3> corners;
        CellShape shape = CellShape::tetrahedron;
        switch (random.below(5)) {
        case 0:
            shape = CellShape::hexahedron;
            corners.assign(box.begin(), box.end());
            break;
        case 1:
            shape = CellShape::wedge;
            corners = {box[0], box[3], box[1], box[4], box[7], box[5]};
            break;
        case 2:
            shape = CellShape::pyramid;
            corners = {box[0], box[1], box[2], box[3], box[4]};
            break;
        default:
            corners = {box[0], box[1], box[3], box[4]};
        }
        if (!std::all_of(corners.begin(), corners.end(), inside))
            continue;
        std::vector<std::uint32_t> v;
        for (const glm::dvec3& p : corners)
            v.push_back(shared_point(mesh, p));
        mesh.add(shape, v);
        return;
    }
}

Mesh scattered_cells(int attempts, int size, std::uint64_t seed)
{
    Random random(seed);
    Mesh mesh;
    for (int i = 0; i < attempts; ++i) {
        Mesh more = mesh;
        add_random_cell(more, random, 0, size);
        const Scene scene(more);
        const auto inner = [&](std::size_t caller) {
            const auto cells = scene.caller_cells();
            return static_cast<CellId>(std::find(cells.begin(), cells.end(), caller) - cells.begin());
        };
        const CellId last = inner(more.cell_count() - 1);
        bool free = true;
        for (std::size_t other = 0; other < mesh.cell_count() && free; ++other)
            free = !brute_force::interiors_overlap(scene, inner(other), last);
        if (free)
            mesh = std::move(more);
    }
    return mesh;
}

std::vector<SmallScene> small_scenes()
{
    std::vector<SmallScene> scenes;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const std::string suffix = " " + std::to_string(seed);
        const int i = static_cast<int>(seed);
        scenes.push_back({"carved delaunay" + suffix, carved_delaunay(7 + i % 4, 64, 0.5, seed)});
        scenes.push_back({"whole delaunay" + suffix, carved_delaunay(6 + i % 4, 40, 1, seed)});
        scenes.push_back({"boxes" + suffix, box_grid({2, 2 + i % 2, 2}, 1 + i % 3, 0.4, seed)});
        scenes.push_back({"whole boxes" + suffix, whole_boxes({3, 2, 2}, 1 + i % 3, 0.4, seed)});
        scenes.push_back({"scattered cells, close" + suffix, scattered_cells(60, 4, seed)});
        scenes.push_back({"scattered cells" + suffix, scattered_cells(25, 12 + i, seed)});
    }
    return scenes;
}

Mesh small_scene(std::uint64_t number)
{
    const int i = static_cast<int>(number / 5);
    switch (number % 5) {
    case 0:
        return carved_delaunay(6 + i % 4, 40, 0.5, number);
    case 1:
        return box_grid({2, 2, 1 + i % 2}, 1 + i % 3, 0.4, number);
    case 2:
        return whole_boxes({2, 2, 2}, 1 + i % 3, 0.4, number);
    case 3:
        return scattered_cells(14, 4 + i % 3, number);
    default:
        return scattered_cells(10, 10 + i % 9, number);
    }
}

void add_box(Mesh& mesh, const std::array<glm::dvec3, 8>& corners)
{
    std::array<PointId, 8> v;
    std::iota(v.begin(), v.end(), static_cast<PointId>(mesh.points.size()));
    mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
    mesh.add(CellShape::hexahedron, v);
}

void add_box(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high)
{
    const glm::dvec3 size = high - low;
    add_box(mesh, parallelepiped(low, {size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}));
}

Mesh interlocked_bars(bool solids)
{
    Mesh mesh;
    const std::array<glm::dvec3, 3> corners{{{0, 12, 0}, {-12, -8, 0}, {12, -8, 0}}};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 from = corners[i], to = corners[(i + 1) % 3], along = (to - from) * 0.25;
        const glm::dvec3 low = from - along + glm::dvec3(0, 0, -8), high = to + along + glm::dvec3(0, 0, 8);
        const glm::dvec3 side = glm::dvec3(along.y, -along.x, 0) * 0.25, up(0, 0, 1);
        if (solids) {
            add_box(mesh, {low - side, low + side, high + side, high - side, low - side + up, low + side + up,
                           high + side + up, high - side + up});
            continue;
        }
        const auto first = static_cast<PointId>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), {low - side, low + side, high});
        mesh.add(CellShape::triangle, std::array{first, first + 1, first + 2});
    }
    return mesh;
}

Mesh triangles(const std::vector<glm::dvec3>& corners)
{
    Mesh mesh;
    mesh.points = corners;
    for (PointId i = 0; i + 2 < corners.size(); i += 3)
        mesh.add(CellShape::triangle, std::array{i, i + 1, i + 2});
    return mesh;
}

Mesh random_triangles(int count, int size, std::uint64_t seed)
{
    Random random(seed);
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 3 * count; ++i)
        corners.push_back(random.integer_point(0, size));
    // Some of no area.
    corners[1] = corners[0];
    corners[5] = corners[4] * 2.0 - corners[3];
    return triangles(corners);
}

Mesh overlapping_cells(int count, int size, std::uint64_t seed)
{
    Random random(seed);
    Mesh mesh;
    for (int i = 0; i < count; ++i)
        add_random_cell(mesh, random, 0, size);
    return mesh;
}

Mesh flat_cells()
{
    // A square's two halves below, cut along one diagonal, and above, cut along the other; a flat cell between them.
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 2, -5}, {2, 1, 6}};
    mesh.add(CellShape::tetrahedron, std::array{0u, 1u, 3u, 4u});
    mesh.add(CellShape::tetrahedron, std::array{1u, 2u, 3u, 4u});
    mesh.add(CellShape::tetrahedron, std::array{0u, 1u, 2u, 3u});
    mesh.add(CellShape::tetrahedron, std::array{0u, 2u, 1u, 5u});
    mesh.add(CellShape::tetrahedron, std::array{0u, 2u, 3u, 5u});
    // Another that hangs on a boundary face, one alone, and one that collapsed.
    mesh.points.insert(mesh.points.end(), {{1, 1, -2}, {8, 8, 0}, {9, 8, 0}, {8, 9, 0}, {9, 9, 0}});
    mesh.add(CellShape::tetrahedron, std::array{0u, 1u, 4u, 6u});
    mesh.add(CellShape::tetrahedron, std::array{7u, 8u, 9u, 10u});
    mesh.add(CellShape::tetrahedron, std::array{0u, 1u, 1u, 5u});
    return mesh;
}

Mesh squashed_delaunay(std::uint64_t seed)
{
    Mesh mesh = carved_delaunay(8, 40, 0.8, seed);
    for (std::size_t i = 0; i < mesh.points.size(); i += 1 + seed % 3)
        mesh.points[i].z = 20;
    return mesh;
}

std::vector<glm::dvec3> points_of(const Scene& scene, const CellFace& face)
{
    std::vector<glm::dvec3> points;
    for (PointId v : boundary_loop(scene.mesh(), face))
        points.push_back(scene.mesh().points[v]);
    return points;
}

std::vector<glm::dvec4> small_scene_eyes(const Scene& scene, std::uint64_t seed)
{
    Random random(seed);
    const Box& box = scene.bounds();
    // Scenes may be far larger than integers go; these eyes then lie in their middle.
    const int low = static_cast<int>(std::max(-1e6, std::min({box.min.x, box.min.y, box.min.z})));
    const int high = static_cast<int>(std::min(1e6, std::max({box.max.x, box.max.y, box.max.z})));
    std::vector<glm::dvec4> eyes;
    for (int i = 0; i < 3; ++i) {
        eyes.emplace_back(random.integer_point(low - 100, high + 100), 1);
        eyes.emplace_back(random.integer_point(low - 2, high + 2), 1);
    }
    for (int i = 0; i < 3; ++i)
        eyes.emplace_back(random.integer_point(low, high), 1);
    eyes.emplace_back(random.integer_point(-4000, 4000), 1);
    eyes.emplace_back(box.max, 1);
    const auto& points = scene.mesh().points;
    for (int i = 0; i < 2; ++i) {
        const auto chosen = static_cast<std::size_t>(random.below(static_cast<int>(points.size())));
        eyes.emplace_back(points[chosen], 1);
        // In the plane of grid faces, or of a face.
        eyes.emplace_back(points[chosen] + glm::dvec3(0, random.from_to(-90, 90), random.from_to(-90, 90)), 1);
        const auto v = scene.mesh().cell(static_cast<CellId>(random.below(static_cast<int>(scene.cell_count()))));
        eyes.emplace_back(points[v[0]] * 3.0 - points[v[1]] - points[v[2]], 1);
    }
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)})
        eyes.emplace_back(axis, 0);
    for (int i = 0; i < 2; ++i) {
        const glm::dvec3 direction = random.integer_point(-9, 9);
        eyes.emplace_back(direction == glm::dvec3(0) ? glm::dvec3(1) : direction, 0);
    }
    return eyes;
}

} // namespace visorder::tests
