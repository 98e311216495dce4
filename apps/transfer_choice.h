#pragma once

#include "apps/scene_source.h"
#include "visorder/scene.h"
#include "visorder/transfer_function.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

namespace visorder::apps {

/// The transfer function that the command line asks for.
struct TransferChoice {
    std::string name = "cool-warm"; ///< of one, or of a file: FILE or FILE@MAP
    std::string map;                ///< of a ParaView file with several
    std::string map_range = "data"; ///< of a ParaView file's scalars: data or file
    double unit_length = 0;         ///< 0: a tenth of the scene's diameter
};

/// Adds --transfer, --map, --map-range and --unit-length.
std::shared_ptr<TransferChoice> add_transfer_choice(CLI::App& command);

/// The function over the scalars of the scene; what was chosen for want of being told goes to `notes`, a line each.
/// Throws InputError where there is no such function.
TransferFunction transfer_function_of(const TransferChoice& choice, const Scene& scene, const ScalarMap& map,
                                      std::vector<std::string>& notes);

/// The distance over which opacities hold.
double unit_length_of(const TransferChoice& choice, const Scene& scene);

} // namespace visorder::apps
