#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace visorder::apps {

/// --weld, with or without a tolerance.
struct WeldOption {
    bool given = false;
    double tolerance = 0;
};

/// `weld` must live as long as the command.
void add_weld_option(CLI::App& command, WeldOption& weld);

/// The arguments of a command line in which --weld and its tolerance, 0 where none follows, are one argument: so what
/// follows --weld and is no number, such as the name of a mesh, is not taken for its value.
std::vector<std::string> with_joined_weld_tolerance(std::vector<std::string> arguments);

} // namespace visorder::apps
