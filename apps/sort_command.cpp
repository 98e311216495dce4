#include "apps/commands.h"
#include "apps/order_file.h"
#include "apps/output_file.h"
#include "apps/scene_source.h"
#include "apps/sorter_options.h"
#include "apps/view_choice.h"
#include "visorder/error.h"
#include "visorder/sorter_options.h"
#include "visorder/sorters.h"

#include <fmt/format.h>
#include <memory>

namespace visorder::apps {

namespace {

struct Arguments {
    std::shared_ptr<SceneSource> source;
    std::shared_ptr<ViewChoice> view;
    std::string sorter = "auto";
    SorterOptions sorter_options;
    std::string output;
    std::string map;
};

int run(const Arguments& arguments, SourcedMesh& sourced)
{
    const Scene scene(std::move(sourced.mesh));
    const View view = view_of(*arguments.view, scene);
    const auto sorter = make_sorter(arguments.sorter, scene, arguments.sorter_options);
    Order order;
    sorter->sort(view, order);
    write_order(arguments.output, sourced.cells.numbers(order.back_to_front));
    if (!arguments.map.empty())
        write_order(arguments.map, sourced.cells.file_cells());
    std::FILE* const out = message_stream({arguments.output, arguments.map});
    fmt::print(out, "{}: {} cells, farthest first, by {} ({}); {} cycles\n", arguments.output,
               order.back_to_front.size(), named_sorter(arguments.sorter, scene), describe(sorter->guarantee(), scene),
               order.cycles.size());
    if (sourced.source_cells != scene.cell_count())
        fmt::print(out, "cells are the tetrahedra of {} cells; --map FILE tells of which each is part\n",
                   sourced.source_cells);
    else if (!sourced.cells.whole())
        fmt::print(out, "cells are parts of the file's cells; --map FILE tells of which each is part\n");
    tell_faults(out, sourced, scene);
    return exit_success;
}

int run(const Arguments& arguments)
{
    if (arguments.output == arguments.map)
        throw InputError(fmt::format("{}: both the order and the map cannot go there", arguments.output));
    require_writable(arguments.output);
    if (!arguments.map.empty())
        require_writable(arguments.map);
    SourcedMesh sourced = load(*arguments.source);
    return with_names_of(sourced, [&] { return run(arguments, sourced); });
}

} // namespace

void add_sort_command(CLI::App& app, Command& chosen)
{
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("sort", "Order the cells of a mesh as seen from an eye");
    arguments->source = add_scene_source(*command);
    arguments->view = add_view_choice(*command);
    command->add_option("--sorter", arguments->sorter, "Which one; `visorder sorters` lists them")
        ->capture_default_str();
    add_sorter_options(*command, arguments->sorter_options);
    command
        ->add_option("-o,--output", arguments->output,
                     "Where to: .npy, or text with a cell per line; - for standard output. Cells have the numbers that "
                     "they have in the file, "
                     "counted from 0 over all that it lists; where cells were cut into parts, the parts are "
                     "numbered from 0, cell by cell")
        ->required();
    command->add_option(
        "--map", arguments->map,
        "Also write, for each cell or part in turn, the number in the file of the cell it is (part of)");
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
