#include "apps/commands.h"
#include "apps/number_check.h"
#include "apps/order_file.h"
#include "apps/scene_source.h"
#include "apps/view_choice.h"
#include "visorder/checking.h"
#include "visorder/error.h"

#include <algorithm>
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

Order read_order_of(const CellNumbers& cells, const std::string& file)
{
    Order order;
    try {
        order.back_to_front = cells.cells(read_order(file));
    } catch (const InputError& error) {
        const std::string what = error.what();
        throw InputError(what.starts_with(file) ? what : fmt::format("{}: {}", file, what));
    }
    return order;
}

/// Prints the first of the lines, and how many more there are.
template <class Items, class Line>
void list(const Items& items, std::size_t count, std::size_t most, const Line& line)
{
    std::size_t shown = 0;
    for (const auto& item : items)
        if (shown < most) {
            line(item);
            ++shown;
        }
    if (shown < count)
        fmt::print("  and {} more\n", count - shown);
}

void print_violations(const CellNumbers& cells, const std::vector<Violation>& witnesses, std::size_t violations,
                      std::size_t most)
{
    list(witnesses, violations, most, [&](const Violation& v) {
        fmt::print("  {} occludes {} but is painted before it; a ray meets both at {:.17g},{:.17g},{:.17g}\n",
                   cells.name(v.front), cells.name(v.back), v.witness.x, v.witness.y, v.witness.z);
    });
}

// Holds the order against the direct relation of all pairs; returns the violations.
std::size_t check_pairs(const Scene& scene, const View& view, const Order& order, const CellNumbers& cells,
                        std::size_t most)
{
    const CheckResult result = DirectRelations(scene, view.eye).check(order, {most});
    fmt::print("all pairs: {} of {} pairs of which one cell occludes the other are in the wrong order\n",
               result.violations, result.relations);
    print_violations(cells, result.witnesses, result.violations, most);
    return result.violations;
}

// Holds the order against rays; returns the violations.
std::size_t check_rays(const Scene& scene, const View& view, const Order& order, const CellNumbers& cells,
                       const CheckResult& known, const Arguments& arguments)
{
    const RayAudit audit(scene, view.eye, {.rays = arguments.rays});
    const RayAuditResult result = audit.check(order, known.unorderable, {arguments.witnesses});
    fmt::print("{} rays: {} pairs of cells behind each other, {} pairs in the wrong order\n", result.rays, result.pairs,
               result.violations);
    print_violations(cells, result.witnesses, result.violations, arguments.witnesses);
    return result.violations;
}

int run(const Arguments& arguments, SourcedMesh& sourced)
{
    const CellNumbers& cells = sourced.cells;
    const Scene scene(std::move(sourced.mesh));
    const Order order = read_order_of(cells, arguments.order_file);
    const View view = view_of(*arguments.view, scene);
    const CheckResult result = OrderChecker(scene).check(view.eye, order, {arguments.witnesses});
    const std::size_t most = arguments.witnesses;
    fmt::print("{} of {} relations violated\n", result.violations, result.relations);
    print_violations(cells, result.witnesses, result.violations, most);
    if (result.violations_across_cycles > 0)
        fmt::print("{} of these are pairs whose one cell occludes the other through cells of a cycle\n",
                   result.violations_across_cycles);
    if (!result.unorderable.empty())
        fmt::print("no order exists of {} sets of cells, each of which occlude one another in a cycle\n",
                   result.unorderable.size());
    list(result.unorderable, result.unorderable.size(), most, [&](const std::vector<CellId>& set) {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < std::min(set.size(), most); ++i)
            names.push_back(cells.name(set[i]));
        fmt::print("  {} cells: {}{}\n", set.size(), fmt::join(names, ", "),
                   names.size() < set.size() ? fmt::format(" and {} more", set.size() - names.size()) : "");
    });
    if (result.violations_in_cycles > 0)
        fmt::print("{} relations violated within such sets, where some must be\n", result.violations_in_cycles);
    if (!result.overlapping.empty())
        fmt::print("{} pairs of cells overlap in space: they have no order, and their relations are not counted\n",
                   result.overlapping.size());
    list(result.overlapping, result.overlapping.size(), most,
         [&](const auto& pair) { fmt::print("  {} and {}\n", cells.name(pair.first), cells.name(pair.second)); });
    tell_faults(stdout, sourced, scene);
    std::size_t violations = result.violations;
    if (arguments.pairs || scene.cell_count() <= few_cells)
        violations += check_pairs(scene, view, order, cells, most);
    if (arguments.rays > 0)
        violations += check_rays(scene, view, order, cells, result, arguments);
    return violations > 0 ? exit_wrong : exit_success;
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
    SourcedMesh sourced = load(source);
    return with_names_of(sourced, [&] { return run(arguments, sourced); });
}

} // namespace

void add_check_command(CLI::App& app, Command& chosen)
{
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("check", "Hold an order against all relations of a mesh; exit code 1 if it is wrong");
    arguments->source = add_scene_source(*command);
    command->add_option("order", arguments->order_file,
                        "The order, as sort writes it: .npy, or text with a cell per line, farthest first");
    arguments->view = add_view_choice(*command);
    command->add_option("--witnesses", arguments->witnesses, "Cells, or pairs of cells, to show of each kind")
        ->capture_default_str()
        ->check(count_from(0));
    command
        ->add_option("--rays", arguments->rays, "Also hold the order against this many rays, which know no relations")
        ->check(count_from(0));
    command->add_flag("--pairs", arguments->pairs,
                      "Also try all pairs of cells, from their vertices alone (unasked up to 2000 cells)");
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
