#include "apps/scene_source.h"

#include "bench/generated_scene.h"
#include "files/read_mesh.h"
#include "scene/error.h"
#include "scene/subdivision.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>

namespace visorder::apps {

using namespace scenes;

std::shared_ptr<SceneSource> add_scene_source(CLI::App& command)
{
    auto source = std::make_shared<SceneSource>();
    command.add_option("mesh", source->file,
                       "A mesh: " + fmt::format("{}", fmt::join(mesh_file_endings(), ", ")) +
                           ", and most of them with .gz");
    command.add_option("--scene", source->generated, "A generated scene instead, NAME[:SIZE[:SEED]]");
    command.add_option("--scalar", source->scalar, "The array to take (default: the format's)");
    command.add_flag("--weld", source->weld, "Join points with exactly equal coordinates");
    command.add_option("--time", source->time,
                       "The time step to take: first, last, index:N or its time (default: last)");
    command.add_flag("--whole", source->whole, "Keep zoo cells whole instead of subdividing them into tetrahedra");
    return source;
}

SourcedMesh load(const SceneSource& source)
{
    if (source.file.empty() && source.generated.empty())
        throw InputError("no mesh given: name a file, or a generated scene by --scene");
    if (!source.file.empty() && !source.generated.empty())
        throw InputError("both a mesh and --scene given; one of them can be taken");
    SourcedMesh result;
    if (!source.generated.empty()) {
        result.name = source.generated;
        result.mesh = generate(source.generated);
    } else {
        result.name = source.file;
        MeshFile file = read_mesh(source.file, {.scalar = source.scalar, .weld = source.weld, .time = source.time});
        result.mesh = std::move(file.mesh);
        result.scalar = std::move(file.scalar);
        result.notes = std::move(file.notes);
    }
    result.source_cells = result.mesh.cell_count();
    if (source.whole) {
        result.cell_of.resize(result.source_cells);
        std::iota(result.cell_of.begin(), result.cell_of.end(), CellId{0});
    } else {
        Subdivision subdivision = subdivide(result.mesh);
        result.mesh = std::move(subdivision.mesh);
        result.cell_of = std::move(subdivision.cell_of);
    }
    return result;
}

} // namespace visorder::apps
