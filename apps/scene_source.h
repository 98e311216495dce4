#pragma once

#include "scene/mesh.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace visorder::apps {

/// The one mesh that a subcommand works on, as the command line names it.
struct SceneSource {
    std::string file;
    std::string generated;
    std::string scalar;
    bool weld = false;
    std::string time; ///< as in ReadOptions
    bool whole = false;
};

/// What it names.
struct SourcedMesh {
    std::string name;
    Mesh mesh;                    ///< tetrahedra, unless whole zoo cells were asked for
    std::vector<CellId> cell_of;  ///< of each cell, that of the source which it is part of
    std::size_t source_cells = 0; ///< before subdivision
    std::string scalar;           ///< the array that was taken
    std::vector<std::string> notes;
};

/// Adds MESH, --scene, --scalar, --weld, --time and --whole.
std::shared_ptr<SceneSource> add_scene_source(CLI::App& command);

/// Reads or makes the mesh. Throws InputError.
SourcedMesh load(const SceneSource& source);

} // namespace visorder::apps
