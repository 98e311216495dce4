#include "apps/commands.h"
#include "apps/weld_option.h"
#include "visorder/error.h"
#include "visorder/version.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <oneapi/tbb/global_control.h>
#include <string>
#include <utility>
#include <vector>

namespace {

int bad_input(const std::string& message)
{
    fmt::print(stderr, "visorder: {}\n", message);
    return visorder::apps::exit_bad_input;
}

bool command_named(const CLI::App& app, const std::string& word)
{
    return !app.get_subcommands([&](const CLI::App* command) { return command->get_name() == word; }).empty();
}

/// The word that stands where a command is due, if it is none.
std::string unknown_command(const CLI::App& app, int argc, char** argv)
{
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--threads")
            ++i; // its number
        else if (!word.starts_with('-'))
            return command_named(app, word) ? "" : word;
    }
    return "";
}

std::string command_names(const CLI::App& app)
{
    std::string names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names += (names.empty() ? "" : ", ") + command->get_name();
    return names;
}

} // namespace

int main(int argc, char** argv)
{
    using namespace visorder;
    using namespace visorder::apps;
    CLI::App app{"visorder: visibility orders of the cells of 3D scenes", "visorder"};
    app.set_version_flag("--version", std::string("visorder ") + version);
    app.require_subcommand(1);
    int threads = 0;
    app.add_option("--threads", threads, "Threads to use (default: all)")->check(CLI::Range(1, 1024));
    app.fallthrough();
    Command command;
    add_compare_command(app, command);
    add_sort_command(app, command);
    add_check_command(app, command);
    add_render_command(app, command);
    add_inspect_command(app, command);
    add_layers_command(app, command);
    add_sorters_command(app, command);
    try {
        std::vector<std::string> arguments = with_joined_weld_tolerance({argv + 1, argv + argc});
        std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes a vector of them
        app.parse(std::move(arguments));
    } catch (const CLI::Success& success) {
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        if (const std::string word = unknown_command(app, argc, argv); !word.empty())
            return bad_input(fmt::format("there is no command \"{}\"; there are: {}", word, command_names(app)));
        return bad_input(error.what());
    }
    try {
        using oneapi::tbb::global_control;
        std::unique_ptr<global_control> limit;
        if (threads > 0)
            limit = std::make_unique<global_control>(global_control::max_allowed_parallelism, threads);
        return command();
    } catch (const InputError& error) {
        return bad_input(error.what());
    } catch (const std::bad_alloc&) {
        return bad_input("not enough memory");
    } catch (const std::exception& error) {
        return bad_input(error.what());
    }
}
