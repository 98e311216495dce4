#include "apps/commands.h"
#include "apps/scene_source.h"
#include "scene/scene.h"
#include "sorting/registry.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>

namespace visorder::apps {

namespace {

const char* yes_or_no(bool yes)
{
    return yes ? "yes" : "no";
}

int run(SourcedMesh& sourced)
{
    const bool has_scalars = !sourced.mesh.scalars.empty();
    const auto [low, high] = std::minmax_element(sourced.mesh.scalars.begin(), sourced.mesh.scalars.end());
    const float least = has_scalars ? *low : 0, greatest = has_scalars ? *high : 0;
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
    fmt::print("  bounds          {:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}\n", box.min.x, box.min.y, box.min.z,
               box.max.x, box.max.y, box.max.z);
    if (has_scalars)
        fmt::print("  scalar          {} from {:.6g} to {:.6g}\n",
                   sourced.scalar.empty() ? "(unnamed)" : sourced.scalar, least, greatest);
    else
        fmt::print("  scalar          none\n");
    const Traits& traits = scene.traits();
    fmt::print("  boundary        {} {} in {} components\n", scene.boundary().faces.size(),
               scene.is_surface() ? "edges" : "faces", scene.boundary().component_count);
    fmt::print("  flat cells      {}\n", traits.flat_cells);
    if (!scene.is_surface()) {
        fmt::print("  inverted cells  {}\n", traits.inverted_cells);
        fmt::print("  folded faces    {}\n", traits.folded_faces);
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
    return exit_success;
}

int run(const SceneSource& source)
{
    SourcedMesh sourced = load(source);
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
