#pragma once

#include "apps/weld_option.h"
#include "files/cell_numbers.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace visorder::apps {

using namespace detail;

/// The one mesh that a subcommand works on, as the command line names it.
struct SceneSource {
    std::string file;
    std::string generated;
    std::string scalar;
    WeldOption weld;
    std::string time; ///< as in ReadOptions
    bool whole = false;
};

/// What it names.
struct SourcedMesh {
    std::string name;
    Mesh mesh;                        ///< tetrahedra, unless whole mixed-element cells were asked for
    CellNumbers cells{{}, {}};        ///< what they are called
    std::size_t source_cells = 0;     ///< before subdivision
    std::string scalar;               ///< the array that was taken
    ScalarMap scalar_map;             ///< from the mesh's scalars to the array's
    std::vector<ArraySummary> arrays; ///< of the file, if they were asked for
    std::vector<std::string> notes;
};

/// Adds MESH, --scene, --scalar, --weld, --time and --whole.
std::shared_ptr<SceneSource> add_scene_source(CLI::App& command);

/// Reads or makes the mesh. Throws InputError.
SourcedMesh load(const SceneSource& source, bool list_arrays = false);

/// Says, in one line of `out`, what the scene of the mesh has that no mesh should.
void tell_faults(std::FILE* out, const SourcedMesh& sourced, const Scene& scene);

/// Runs what a command does with the mesh; what it throws of a cell names the source, and the cell as the source does.
int with_names_of(const SourcedMesh& sourced, const std::function<int()>& body);

} // namespace visorder::apps
