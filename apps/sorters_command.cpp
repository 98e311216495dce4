#include "apps/commands.h"
#include "visorder/sorters.h"

#include <fmt/format.h>

namespace visorder::apps {

namespace {

int run()
{
    for (const SorterInfo& info : sorters()) {
        std::string structures;
        for (Structure structure : info.structures)
            structures += (structures.empty() ? "" : ", ") + std::string(name(structure));
        fmt::print("{:<16} {}\n{:<16} from:  {}\n{:<16} exact: {}\n{:<16} needs: {}\n", info.name, info.summary, "",
                   info.source, "", info.exact_when, "", structures);
    }
    return exit_success;
}

} // namespace

void add_sorters_command(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand("sorters", "List the sorters: where each comes from and when it is exact");
    command->callback([&chosen] { chosen = run; });
}

} // namespace visorder::apps
