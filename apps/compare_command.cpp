#include "apps/commands.h"
#include "apps/image_size.h"
#include "apps/number_check.h"
#include "apps/output_file.h"
#include "apps/progress.h"
#include "apps/sorter_options.h"
#include "apps/view_choice.h"
#include "apps/weld_option.h"
#include "bench/comparison.h"
#include "bench/report.h"

#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <unistd.h>

namespace visorder::apps {

using namespace bench;

namespace {

struct Arguments {
    ComparisonOptions options;
    std::vector<std::string> sorters;
    std::string size = "512x512";
    std::vector<double> up;
    std::string json_file;
    WeldOption weld;
    bool whole = false;
    bool statistics = false;
};

// A convex, a carved, a tie-ridden and a curvilinear scene, and a true cycle.
const std::vector<std::string> default_scenes{"delaunay:200000", "carved:200000", "grid:150000", "fin:150000",
                                              "pinwheel"};

std::vector<std::string> refused_names(const Comparison& comparison)
{
    std::vector<std::string> names;
    for (const Refusal& refusal : comparison.refused)
        names.push_back(refusal.source);
    return names;
}

int run(Arguments& arguments)
{
    ComparisonOptions& options = arguments.options;
    options.weld = arguments.weld.given;
    options.weld_tolerance = arguments.weld.tolerance;
    options.size = image_size(arguments.size, "--size");
    options.subdivide = !arguments.whole;
    if (!arguments.up.empty())
        options.up = up_direction(arguments.up);
    if (arguments.sorters != std::vector<std::string>{"all"})
        options.sorters = arguments.sorters;
    if (options.files.empty() && options.generated.empty())
        options.generated = default_scenes;
    if (!arguments.json_file.empty())
        require_writable(arguments.json_file);
    if (!options.images.empty())
        require_writable_folder(options.images);
    Comparison comparison;
    {
        Progress progress;
        comparison = compare(options, [&](const std::string& what) { progress.show(what); });
    }
    Machine machine = this_machine();
    if (!comparison.gl_renderer.empty())
        machine.gl_renderer = comparison.gl_renderer;
    if (!arguments.json_file.empty())
        write_file(arguments.json_file, json(comparison, machine));
    for (const Refusal& refusal : comparison.refused)
        fmt::print(stderr, "visorder: {}\n", refusal.reason);
    if (comparison.scenes.empty())
        return exit_bad_input;
    const int views = comparison.runs.empty() ? 0 : comparison.runs.back().view + 1;
    std::FILE* const out = message_stream({arguments.json_file});
    fmt::print(out, "{}, {} thread{}; {} views a scene: times are medians over them, counts are sums\n\n{}",
               machine.cpu, machine.threads, machine.threads == 1 ? "" : "s", views,
               table(comparison, isatty(fileno(out)) != 0, arguments.statistics));
    if (!comparison.refused.empty())
        fmt::print(out, "\nnot compared, for what standard error says: {}\n",
                   fmt::join(refused_names(comparison), ", "));
    return !comparison.refused.empty() ? exit_bad_input : comparison.failed() ? exit_wrong : exit_success;
}

} // namespace

void add_compare_command(CLI::App& app, Command& chosen)
{
    auto arguments = std::make_shared<Arguments>();
    ComparisonOptions& options = arguments->options;
    CLI::App* command =
        app.add_subcommand("compare", "Run sorters on scenes: what each costs and what each gets wrong");
    command->add_option("mesh", options.files, "Meshes: .vtu, .vtk, .ex2, .e, .exo, ...xyz.bin, .obj");
    command->add_option("--scene", options.generated, "Generated scenes, NAME[:SIZE[:SEED]]")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--sorters", arguments->sorters, "Sorters, a,b,... (default: all)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--views", options.views, "Random views of each scene")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_flag("--hard", options.hard_views, "Also the views from which orders go wrong first");
    command->add_option("--size", arguments->size, "Pixels of a view, WxH")->capture_default_str();
    add_up_option(*command, arguments->up)
        ->description(
            "The direction that is up in pictures, X,Y,Z, but in views along it (default: what suits the scene)");
    command->add_option("--seed", options.seed, "Of the random views")->capture_default_str()->check(count_from(0));
    command->add_option("--repeats", options.repeats, "Timed sorts a view, of which the median counts")
        ->capture_default_str()
        ->check(CLI::Range(5, 1000));
    command->add_option("--scalar", options.scalar, "The array to take of each mesh (default: the format's)");
    command->add_option("--time", options.time, "The time step to take of each mesh (default: its last)");
    add_weld_option(*command, arguments->weld);
    command->add_flag("--whole", arguments->whole, "Keep zoo cells whole instead of subdividing them into tetrahedra");
    command->add_option("--audit", options.audit_rays,
                        "Also hold every order against this many rays from each view, which know no relations");
    command->add_flag("--statistics", arguments->statistics, "Also what each sorter counts of its own work");
    add_sorter_options(*command, options.sorter_options);
    command
        ->add_option("--frames", options.frames,
                     "Views from which the scene is drawn in every order, for image errors; 0: nothing is drawn")
        ->capture_default_str()
        ->check(CLI::Range(0, 10000));
    command->add_option("--images", options.images,
                        "A folder to keep the frames in, and how they differ from the exact order's, tenfold");
    command->add_option("--json", arguments->json_file, "Write every run to a file; - for standard output");
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
