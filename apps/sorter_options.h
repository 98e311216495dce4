#pragma once

#include "visorder/sorter_options.h"
#include "visorder/sorters.h"

#include <CLI/CLI.hpp>
#include <string>

namespace visorder::apps {

/// Adds the options of the sorters to a command. `options` must live until the command has run.
void add_sorter_options(CLI::App& command, SorterOptions& options);

/// A sorter's name as it stands in messages: of `auto`, with the one that it takes for the scene.
std::string named_sorter(const std::string& sorter, const Scene& scene);

} // namespace visorder::apps
