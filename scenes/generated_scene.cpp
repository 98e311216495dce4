#include "scenes/generated_scene.h"

#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"
#include "visorder/box.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace visorder::scenes {

namespace {

struct Family {
    GeneratedScene scene;
    std::size_t minimum_cells;
    Mesh (*make)(std::size_t cells, std::uint64_t seed);
};

constexpr std::uint64_t default_seed = 1;
constexpr std::size_t maximum_cells = std::size_t{1} << 29;

constexpr std::array families{
    Family{{"delaunay", "random points in a cube, Delaunay: convex", 100'000}, 100, delaunay_scene},
    Family{{"carved", "delaunay with half its cells removed along a gyroid: not convex, acyclic", 100'000},
           100,
           carved_scene},
    Family{{"grid", "equal cubes in rows: every power key ties", 105'456}, 6, grid_scene},
    Family{{"fin", "curvilinear grid around a blunt fin on a plate, hexahedra", 224'874}, 24, fin_scene},
    Family{{"post", "O-grid around a cylinder, hexahedra", 100'000}, 18, post_scene},
    Family{{"gear", "wheel with teeth and a bore, hexahedra", 100'000}, 288, gear_scene},
    Family{{"gear-helical", "the same with teeth that wind around the axis: hexahedra with faces that are not planar",
            100'000},
           900,
           helical_gear_scene},
    Family{{"reactor", "block with many straight channels, hexahedra", 100'000}, 192, reactor_scene},
    Family{{"tori", "two linked rings that do not touch, hexahedra", 100'000}, 96, tori_scene},
    Family{{"pinwheel", "three rings of cells of which one at least is a cycle from every direction", 96},
           48,
           pinwheel_scene},
    Family{
        {"slivers", "a lattice moved by a billionth, Delaunay: many cells all but flat", 100'000}, 100, sliver_scene},
    Family{{"offset", "delaunay far from the origin", 100'000}, 100, offset_scene},
    Family{{"contact", "two blocks that touch in a plane without sharing faces", 100'000}, 200, contact_scene},
    Family{{"cavity", "a shell with an island inside, from a delaunay scene", 100'000}, 2'000, cavity_scene},
    Family{{"sphere", "triangles: one sphere", 20'000}, 20, sphere_scene},
    Family{{"shells", "triangles: five spheres, one within the other", 20'000}, 300, shells_scene},
    Family{{"knot", "triangles: a tube around a trefoil knot", 20'000}, 300, knot_scene},
    Family{{"cards", "triangles: rectangles that pass through each other", 20'000}, 4, cards_scene},
};

const Family& family_named(std::string_view name)
{
    for (const Family& family : families)
        if (family.scene.name == name)
            return family;
    std::string known;
    for (const Family& family : families)
        known += (known.empty() ? "" : ", ") + std::string(family.scene.name);
    throw InputError("unknown scene '" + std::string(name) + "'; known are " + known);
}

std::uint64_t parse_number(std::string_view text, const char* what, std::string_view specification)
{
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size())
        throw InputError("scene '" + std::string(specification) + "': " + what + " '" + std::string(text) +
                         "' is not a whole number in range");
    return number;
}

// The text up to the next colon, which goes from `rest` together with the colon.
std::string_view take_part(std::string_view& rest)
{
    const std::size_t colon = rest.find(':');
    const std::string_view part = rest.substr(0, colon);
    rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
    return part;
}

// A smooth function of the place within the mesh's bounds, in [0, 1].
std::vector<float> smooth_scalars(const std::vector<glm::dvec3>& points)
{
    Box bounds;
    for (const glm::dvec3& point : points)
        bounds.add(point);
    std::vector<float> scalars;
    scalars.reserve(points.size());
    for (const glm::dvec3& point : points) {
        const glm::dvec3 p = (point - bounds.min) / (bounds.max - bounds.min);
        const double waves = sine_of_turns(0.8 * p.x + 0.3 * p.y) + sine_of_turns(0.7 * p.y - 0.4 * p.z + 0.2) +
                             sine_of_turns(0.9 * p.z + 0.5 * p.x + 0.6);
        scalars.push_back(static_cast<float>(0.5 + waves / 6));
    }
    return scalars;
}

} // namespace

std::span<const GeneratedScene> generated_scenes()
{
    static const std::vector<GeneratedScene> scenes = [] {
        std::vector<GeneratedScene> result;
        for (const Family& family : families)
            result.push_back(family.scene);
        return result;
    }();
    return scenes;
}

Mesh generate(std::string_view specification)
{
    std::string_view rest = specification;
    const Family& family = family_named(take_part(rest));
    const auto colons = std::count(specification.begin(), specification.end(), ':');
    if (colons > 2)
        throw InputError("scene '" + std::string(specification) + "' is not of the form NAME[:SIZE[:SEED]]");
    std::size_t cells = family.scene.default_cells;
    std::uint64_t seed = default_seed;
    if (colons > 0)
        cells = parse_number(take_part(rest), "size", specification);
    if (colons > 1)
        seed = parse_number(take_part(rest), "seed", specification);
    if (cells < family.minimum_cells || cells > maximum_cells)
        throw InputError("scene '" + std::string(specification) + "': size must be between " +
                         std::to_string(family.minimum_cells) + " and " + std::to_string(maximum_cells));

    Mesh mesh = family.make(cells, seed);
    mesh.scalars = smooth_scalars(mesh.points);
    return mesh;
}

} // namespace visorder::scenes
