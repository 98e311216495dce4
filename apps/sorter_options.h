#pragma once

#include "sorting/registry.h"

#include <CLI/CLI.hpp>

namespace visorder::apps {

/// Adds the options of the sorters to a command. `options` must live until the command has run.
void add_sorter_options(CLI::App& command, SorterOptions& options);

} // namespace visorder::apps
