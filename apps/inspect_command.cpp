#include "apps/commands.h"
#include "apps/scene_source.h"
#include "scene/boundary.h"
#include "scene/face_planes.h"
#include "scene/scalar_interval.h"
#include "visorder/scene.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace visorder::apps {

using namespace detail;

namespace {

const char* yes_or_no(bool yes)
{
    return yes ? "yes" : "no";
}

/// A number with six digits, or as many more as it takes to place it in an interval of this width.
std::string placed_in(double width, double number)
{
    for (int digits = 6; digits < 17; ++digits) {
        std::string text = fmt::format("{:.{}g}", number, digits);
        if (!(std::abs(std::strtod(text.c_str(), nullptr) - number) > 1e-4 * width))
            return text;
    }
    return fmt::format("{:.17g}", number);
}

std::string interval(double lowest, double highest)
{
    const double width = highest - lowest;
    return fmt::format("from {} to {}", placed_in(width, lowest), placed_in(width, highest));
}

std::string corner(const glm::dvec3& point, const Box& box)
{
    const glm::dvec3 size = box.max - box.min;
    return fmt::format("{},{},{}", placed_in(size.x, point.x), placed_in(size.y, point.y), placed_in(size.z, point.z));
}

void print_arrays(const std::vector<ArraySummary>& arrays)
{
    for (const ArraySummary& array : arrays) {
        fmt::print("  array           {}: of {}, ", array.name, array.on_cells ? "cells" : "points");
        if (!array.type.empty())
            fmt::print("{}, ", array.type);
        fmt::print("{} component{}{}, ", array.components, array.components == 1 ? "" : "s",
                   array.holds_ids ? ", ids" : "");
        fmt::print("{}", array.finite == 0 ? "nothing finite" : interval(array.lowest, array.highest));
        if (array.missing > 0)
            fmt::print(", {} missing", array.missing);
        fmt::print("\n");
    }
}

int run(SourcedMesh& sourced)
{
    const std::optional<ScalarInterval> scalars = scalar_interval(sourced.mesh);
    const bool all_missing = std::none_of(sourced.mesh.scalars.begin(), sourced.mesh.scalars.end(),
                                          [](float scalar) { return std::isfinite(scalar); });
    std::array<std::size_t, 5> of_shape{};
    for (CellShape shape : sourced.mesh.shapes)
        ++of_shape[static_cast<std::size_t>(shape)];
    const Scene scene(std::move(sourced.mesh));

    fmt::print("{}\n", sourced.name);
    for (const std::string& note : sourced.notes)
        fmt::print("  ({})\n", note);
    fmt::print("  cells           {}", scene.cell_count());
    for (std::size_t i = 0; i < of_shape.size(); ++i)
        if (of_shape[i] > 0)
            fmt::print("  {} {}", of_shape[i], name(static_cast<CellShape>(i)));
    if (sourced.source_cells != scene.cell_count())
        fmt::print("  (of {} cells, subdivided)", sourced.source_cells);
    const Box& box = scene.bounds();
    fmt::print("\n  points          {}\n", scene.mesh().points.size());
    fmt::print("  bounds          {} to {}\n", corner(box.min, box), corner(box.max, box));
    const ScalarMap& map = sourced.scalar_map;
    if (scalars)
        fmt::print("  scalar          {} {}\n", sourced.scalar.empty() ? "(unnamed)" : sourced.scalar,
                   all_missing ? "has nothing finite"
                               : interval(map.value(scalars->lowest), map.value(scalars->highest)));
    else
        fmt::print("  scalar          none\n");
    print_arrays(sourced.arrays);
    const Traits& traits = scene.traits();
    fmt::print("  boundary        {} {} in {} components\n", scene.boundary().faces.size(),
               scene.is_surface() ? "edges" : "faces", scene.boundary().component_count);
    fmt::print("  flat cells      {}\n", traits.flat_cells);
    if (!scene.is_surface()) {
        fmt::print("  inverted cells  {}\n", traits.inverted_cells);
        fmt::print("  folded faces    {}\n", traits.folded_faces);
        fmt::print("  crowded faces   {}\n", traits.crowded_faces);
        fmt::print("  convex          {}\n", yes_or_no(traits.convex));
        fmt::print("  Delaunay        {}\n", yes_or_no(traits.delaunay));
        fmt::print("  face to face    {}\n", yes_or_no(traits.face_to_face));
        fmt::print("  planar faces    {}\n", yes_or_no(traits.planar_faces));
    }
    if (!scene.is_surface() && traits.planar_faces)
        fmt::print("  overlaps        {}\n",
                   scene.overlapping_cells().empty()
                       ? std::string("no cells overlap")
                       : fmt::format("{} pairs of cells; orders are {}", scene.overlapping_cells().size(),
                                     describe(exact_up_to_overlaps(scene), scene)));
    const AutoChoice choice = choose_sorter(scene);
    fmt::print("  auto            {}: {}\n", choice.name, choice.reason);
    if (traits.planar_faces)
        scene.face_planes();
    for (const StructureRecord& record : scene.derived())
        fmt::print("  {:<15} {:.3f} s, {:.1f} MiB\n", name(record.structure), record.seconds,
                   static_cast<double>(record.bytes) / (1 << 20));
    tell_faults(stdout, sourced, scene);
    return exit_success;
}

int run(const SceneSource& source)
{
    SourcedMesh sourced = load(source, true);
    return with_names_of(sourced, [&] { return run(sourced); });
}

} // namespace

void add_inspect_command(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand(
        "inspect", "Counts, traits and boundary of a mesh, which sorter suits it, and what its structures cost");
    const std::shared_ptr<SceneSource> source = add_scene_source(*command);
    command->callback([source, &chosen] { chosen = [source] { return run(*source); }; });
}

} // namespace visorder::apps
