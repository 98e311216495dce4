#include "apps/scene_source.h"

#include "files/crowded_faces.h"
#include "scenes/generated_scene.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/read_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace visorder::apps {

using namespace detail;

using namespace scenes;

std::shared_ptr<SceneSource> add_scene_source(CLI::App& command)
{
    auto source = std::make_shared<SceneSource>();
    command.add_option("mesh", source->file,
                       "A mesh: " + fmt::format("{}", fmt::join(mesh_file_endings(), ", ")) +
                           ", and most of them with .gz");
    command.add_option("--scene", source->generated, "A generated scene instead, NAME[:SIZE[:SEED]]");
    command.add_option("--scalar", source->scalar, "The array to take (default: the format's)");
    add_weld_option(command, source->weld);
    command.add_option("--time", source->time,
                       "The time step to take: first, last, index:N or its time (default: last)");
    command.add_flag("--whole", source->whole, "Keep zoo cells whole instead of subdividing them into tetrahedra");
    return source;
}

SourcedMesh load(const SceneSource& source, bool list_arrays)
{
    if (source.file.empty() && source.generated.empty())
        throw InputError("no mesh given: name a file, or a generated scene by --scene");
    if (!source.file.empty() && !source.generated.empty())
        throw InputError("both a mesh and --scene given; one of them can be taken");
    SourcedMesh result;
    MeshFile file;
    if (!source.generated.empty()) {
        result.name = source.generated;
        file.mesh = generate(source.generated);
    } else {
        result.name = source.file;
        file = read_mesh(source.file, {.scalar = source.scalar,
                                       .weld = source.weld.given,
                                       .weld_tolerance = source.weld.tolerance,
                                       .time = source.time,
                                       .list_arrays = list_arrays});
    }
    result.source_cells = file.mesh.cell_count();
    if (source.whole) {
        result.cells = cell_numbers(file);
        result.mesh = std::move(file.mesh);
    } else {
        Subdivision subdivision = subdivide(file.mesh);
        result.cells = cell_numbers(file, subdivision.cell_of);
        result.mesh = std::move(subdivision.mesh);
    }
    result.scalar = std::move(file.scalar);
    result.scalar_map = file.scalar_map;
    result.arrays = std::move(file.arrays);
    result.notes = std::move(file.notes);
    return result;
}

void tell_faults(std::FILE* out, const SourcedMesh& sourced, const Scene& scene)
{
    if (const std::string note = crowded_faces_note(scene, sourced.cells); !note.empty())
        fmt::print(out, "{}: {}\n", sourced.name, note);
}

int with_names_of(const SourcedMesh& sourced, const std::function<int()>& body)
{
    try {
        return body();
    } catch (const CellError& error) {
        throw InputError(fmt::format("{}: {}", sourced.name, sourced.cells.message(error)));
    }
}

} // namespace visorder::apps
