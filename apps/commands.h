#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace visorder::apps {

/// What a chosen subcommand does; returns the exit code. Throws InputError.
using Command = std::function<int()>;

// Each adds its subcommand to the command line and, if that is the one given, sets `chosen`.
void add_check_command(CLI::App& app, Command& chosen);
void add_compare_command(CLI::App& app, Command& chosen);
void add_inspect_command(CLI::App& app, Command& chosen);
void add_layers_command(CLI::App& app, Command& chosen);
void add_render_command(CLI::App& app, Command& chosen);
void add_sort_command(CLI::App& app, Command& chosen);
void add_sorters_command(CLI::App& app, Command& chosen);

inline constexpr int exit_success = 0;
inline constexpr int exit_wrong = 1;     ///< an order, or a guarantee, is wrong
inline constexpr int exit_bad_input = 2; ///< and one line on standard error says which

} // namespace visorder::apps
