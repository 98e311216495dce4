#include "apps/commands.h"
#include "apps/order_file.h"
#include "apps/scene_source.h"
#include "apps/view_choice.h"
#include "checking/direct_relations.h"
#include "checking/order_checker.h"
#include "checking/ray_audit.h"
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
    std::size_t rays = 0;
    bool pairs = false;
};

// Scenes of up to this many cells have all their pairs tried without being asked.
constexpr CellId few_cells = 2000;

void print_violations(const std::vector<Violation>& witnesses, std::size_t violations)
{
    for (const Violation& v : witnesses)
        fmt::print("  cell {} occludes cell {} but is painted before it; a ray meets both at {:.17g},{:.17g},{:.17g}\n",
                   v.front, v.back, v.witness.x, v.witness.y, v.witness.z);
    if (violations > witnesses.size())
        fmt::print("  and {} more\n", violations - witnesses.size());
}

// Holds the order against the direct relation of all pairs; returns the violations.
std::size_t check_pairs(const Scene& scene, const View& view, const Order& order, std::size_t witnesses)
{
    const CheckResult result = DirectRelations(scene, view.eye).check(order, {witnesses});
    fmt::print("all pairs: {} of {} pairs of which one cell occludes the other are in the wrong order\n",
               result.violations, result.relations);
    print_violations(result.witnesses, result.violations);
    return result.violations;
}

// Holds the order against rays; returns the violations.
std::size_t check_rays(const Scene& scene, const View& view, const Order& order, const CheckResult& known,
                       const Arguments& arguments)
{
    const RayAudit audit(scene, view.eye, {.rays = arguments.rays});
    const RayAuditResult result = audit.check(order, known.unorderable, {arguments.witnesses});
    fmt::print("{} rays: {} pairs of cells behind each other, {} pairs in the wrong order\n", result.rays, result.pairs,
               result.violations);
    print_violations(result.witnesses, result.violations);
    return result.violations;
}

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
    print_violations(result.witnesses, result.violations);
    if (result.violations_across_cycles > 0)
        fmt::print("{} of these are pairs whose one cell occludes the other through cells of a cycle\n",
                   result.violations_across_cycles);
    for (const std::vector<CellId>& set : result.unorderable)
        fmt::print("no order of these {} cells exists, each occludes the next in a cycle: {}\n", set.size(),
                   fmt::join(set, " "));
    if (result.violations_in_cycles > 0)
        fmt::print("{} relations violated within such sets, where some must be\n", result.violations_in_cycles);
    for (const auto& [a, b] : result.overlapping)
        fmt::print("cells {} and {} overlap in space: they have no order, and their relation is not counted\n", a, b);
    std::size_t violations = result.violations;
    if (arguments.pairs || scene.cell_count() <= few_cells)
        violations += check_pairs(scene, view, order, arguments.witnesses);
    if (arguments.rays > 0)
        violations += check_rays(scene, view, order, result, arguments);
    return violations > 0 ? exit_wrong : exit_success;
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
    command->add_option("--rays", arguments->rays,
                        "Also hold the order against this many rays, which know no relations");
    command->add_flag("--pairs", arguments->pairs,
                      "Also try all pairs of cells, from their vertices alone (unasked up to 2000 cells)");
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
