#include "apps/commands.h"
#include "apps/order_file.h"
#include "apps/scene_source.h"
#include "apps/view_choice.h"
#include "checking/order_checker.h"
#include "scene/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <utility>

namespace visorder::apps {

namespace {

struct Arguments {
    std::shared_ptr<SceneSource> source;
    std::shared_ptr<ViewChoice> view;
    std::string order_file;
    std::size_t witnesses = 16;
};

int run(Arguments& arguments)
{
    std::string& order_file = arguments.order_file;
    SceneSource& source = *arguments.source;
    // With --scene there is no mesh to name, and the one file given is the order.
    if (!source.generated.empty() && order_file.empty())
        std::swap(source.file, order_file);
    if (order_file.empty())
        throw InputError("no order given: name the file that holds it");
    Order order;
    const Scene scene(load(source).mesh);
    order.back_to_front = read_order(order_file);
    const View view = view_of(*arguments.view, scene);
    const CheckResult result = OrderChecker(scene).check(view.eye, order, {arguments.witnesses});
    fmt::print("{} of {} relations violated\n", result.violations, result.relations);
    for (const Violation& v : result.witnesses)
        fmt::print(
            "  cell {} obstructs cell {} but is painted before it; a ray meets both at {:.17g},{:.17g},{:.17g}\n",
            v.front, v.back, v.witness.x, v.witness.y, v.witness.z);
    if (result.violations > result.witnesses.size())
        fmt::print("  and {} more\n", result.violations - result.witnesses.size());
    for (const std::vector<CellId>& set : result.unorderable)
        fmt::print("no order of these {} cells exists, each obstructs the next in a cycle: {}\n", set.size(),
                   fmt::join(set, " "));
    if (result.violations_in_cycles > 0)
        fmt::print("{} relations violated within such sets, where some must be\n", result.violations_in_cycles);
    for (const auto& [a, b] : result.overlapping)
        fmt::print("cells {} and {} overlap in space: they have no order, and their relation is not counted\n", a, b);
    return result.violations > 0 ? exit_wrong : exit_success;
}

} // namespace

void add_check_command(CLI::App& app, Command& chosen)
{
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("check", "Hold an order against all relations of a mesh; exit code 1 if it is wrong");
    arguments->source = add_scene_source(*command);
    command->add_option("order", arguments->order_file, "The order: .npy, or text with a cell a line, farthest first");
    arguments->view = add_view_choice(*command);
    command->add_option("--witnesses", arguments->witnesses, "Violations to show")->capture_default_str();
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
