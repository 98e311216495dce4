// Holds every order of every sorter that says exact against two truths that share no relation with any sorter, all
// pairs of cells and rays, on random small scenes of all hard kinds from all degenerate views. And holds the checker's
// word against the same two, on orders that are wrong wherever the checker might not look. Prints a table of the kinds;
// exit code 1 if any order, or the checker, is wrong.
//
//     visorder_order_audit --scenes 10000
//     visorder_order_audit --kind flat --first 17 --scenes 1 --write /tmp/wrong

#include "scene/orientations.h"
#include "scene/stopwatch.h"
#include "tests/checking/audit_scenes.h"
#include "tests/checking/orders_of_relations.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/sorters.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

struct Arguments {
    std::uint64_t scenes = 1000; // in all, spread over the kinds
    std::uint64_t first = 1;
    std::vector<std::string> kinds;
    std::vector<std::string> sorters;
    std::filesystem::path folder; // for the scenes of wrong orders; empty: none are written
    std::size_t shown = 5;        // wrong orders of each kind
    std::size_t rays = 50;        // of each view
    std::size_t orders = 3;       // made to be wrong, of each view
    double seconds = 0;           // after which no scene is begun; 0: all are
};

struct Counts {
    std::size_t scenes = 0;
    std::size_t views = 0;
    std::size_t orders = 0;
    std::size_t wrong = 0;
    std::size_t false_cycles = 0; // cycles reported that are not the sets without order
    std::size_t refused = 0;      // by a sorter, with a reason
    std::size_t checked = 0;      // orders made to be wrong
    std::size_t missed = 0;       // of them, those about which checker and truth disagree
};

// What is wrong with an order, in words.
struct Verdict {
    enum What { right, wrong, false_cycles } what = right;
    std::string words;
};

// What an eye's orders are held against.
struct Truths {
    DirectRelations pairs;
    RayAudit rays;

    Truths(const Scene& scene, const glm::dvec4& eye, std::size_t ray_count)
        : pairs(scene, eye), rays(scene, eye, {.rays = ray_count})
    {
    }
};

Verdict judge(const Truths& truth, Sorter& sorter, const glm::dvec4& eye)
{
    Order order;
    try {
        sorter.sort({eye, glm::dmat4(1), {64, 64}}, order);
        const CheckResult result = truth.pairs.check(order, {1});
        if (result.violations > 0)
            return {Verdict::wrong,
                    fmt::format("cell {} occludes cell {} but is painted before it ({} of {} relations; "
                                "{} pairs overlap)",
                                result.witnesses[0].front, result.witnesses[0].back, result.violations,
                                result.relations, result.overlapping.size())};
        const RayAuditResult shown = truth.rays.check(order, result.unorderable, {1});
        if (shown.violations > 0)
            return {Verdict::wrong, fmt::format("a ray passes cell {} before cell {}, but it is painted before that",
                                                shown.witnesses[0].front, shown.witnesses[0].back)};
        if (order.cycles != result.unorderable)
            return {Verdict::false_cycles,
                    fmt::format("reports cycles {}; those of the relations are {} ({} pairs overlap)", order.cycles,
                                result.unorderable, result.overlapping.size())};
    } catch (const std::exception& error) {
        return {Verdict::wrong, error.what()};
    }
    return {};
}

Verdict verdict_of(const Mesh& mesh, const std::string& sorter_name, const glm::dvec4& eye)
{
    const Scene scene(mesh);
    const auto sorter = make_sorter(sorter_name, scene);
    if (sorter->guarantee() == Guarantee::approximate)
        return {};
    return judge(Truths(scene, eye, 50), *sorter, eye);
}

Mesh without(const Mesh& mesh, CellId left_out)
{
    Mesh rest;
    rest.points = mesh.points;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        if (cell != left_out)
            rest.add(mesh.shapes[cell], mesh.cell(cell));
    return rest;
}

// The scene without every cell that what is wrong can do without.
Mesh minimised(Mesh mesh, const std::string& sorter, const glm::dvec4& eye, Verdict::What what)
{
    for (CellId cell = static_cast<CellId>(mesh.cell_count()); cell-- > 0 && mesh.cell_count() > 1;) {
        Mesh rest = without(mesh, cell);
        if (verdict_of(rest, sorter, eye).what == what)
            mesh = std::move(rest);
    }
    return mesh;
}

// For a handler of signals: the scene that is being audited.
std::string current_scene;

void name_current_scene(int)
{
    std::fputs(current_scene.c_str(), stderr);
    std::_Exit(3);
}

bool contains(const std::vector<std::string>& names, const std::string& name)
{
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

class Audit {
public:
    Audit(const AuditKind& kind, const Arguments& arguments) : kind_(kind), arguments_(arguments) {}

    void scene(std::uint64_t number)
    {
        number_ = number;
        const AuditScene audited = kind_.scene(number);
        mesh_ = &audited.mesh;
        ++counts_.scenes;
        current_scene = fmt::format("aborted at {} {}\n", kind_.name, number);
        const Scene scene(audited.mesh);
        checker_ = std::make_unique<OrderChecker>(scene);
        std::vector<std::unique_ptr<Sorter>> sorters;
        std::vector<std::string> names;
        for (const SorterInfo& info : visorder::sorters()) {
            // Those that are never exact, and those that draw an image, whose OpenGL takes longer than all else.
            if (arguments_.sorters.empty() && (std::string(info.exact_when).starts_with("never") ||
                                               std::string(info.name).starts_with("xmpvo-layered")))
                continue;
            if (!contains(arguments_.sorters, info.name))
                continue;
            try {
                auto sorter = make_sorter(info.name, scene);
                if (sorter->guarantee() == Guarantee::approximate)
                    continue;
                sorters.push_back(std::move(sorter));
                names.emplace_back(info.name);
            } catch (const InputError&) {
                ++counts_.refused;
            }
        }
        view_ = 0;
        for (const glm::dvec4& eye : audited.eyes) {
            view(scene, eye, sorters, names);
            ++view_;
        }
    }

    const Counts& counts() const { return counts_; }

private:
    void view(const Scene& scene, const glm::dvec4& eye, const std::vector<std::unique_ptr<Sorter>>& sorters,
              const std::vector<std::string>& names)
    {
        ++counts_.views;
        const Truths truth(scene, eye, arguments_.rays);
        check_checker(scene, eye, truth);
        for (std::size_t i = 0; i < sorters.size(); ++i) {
            ++counts_.orders;
            const Verdict verdict = judge(truth, *sorters[i], eye);
            if (verdict.what == Verdict::wrong)
                report(eye, names[i], verdict, ++counts_.wrong);
            else if (verdict.what == Verdict::false_cycles)
                report(eye, names[i], verdict, ++counts_.false_cycles);
        }
    }

    // Orders that satisfy all relations that the checker knows, but for those within cycles, and else are random; and
    // random ones.
    void check_checker(const Scene& scene, const glm::dvec4& eye, const Truths& truth)
    {
        const Relations known = checker_->relations_at(eye);
        for (std::uint64_t i = 0; i < arguments_.orders; ++i) {
            const std::uint64_t seed = (number_ * 1000 + view_) * 1000 + i;
            const Order order = random_order(scene, known, i % 3 < 2, seed);
            const CheckResult said = checker_->check(known, order), result = truth.pairs.check(order, {1});
            ++counts_.checked;
            // Relations through flat cells are some more.
            if ((said.violations == 0) == (result.violations == 0) ||
                (result.violations == 0 && scene.orientations().flat > 0))
                continue;
            if (++counts_.missed > arguments_.shown)
                continue;
            fmt::print(
                "{} {}: checker, eye {:.17g},{:.17g},{:.17g},{:.17g}: says {} violations, but there are {} ({})\n",
                kind_.name, number_, eye.x, eye.y, eye.z, eye.w, said.violations, result.violations,
                fmt::join(order.back_to_front, " "));
            if (!result.witnesses.empty())
                fmt::print("    cell {} occludes cell {}\n", result.witnesses[0].front, result.witnesses[0].back);
            if (arguments_.folder.empty())
                continue;
            std::filesystem::create_directories(arguments_.folder);
            const std::string name = fmt::format("{}_{}_checker_{}", kind_.name, number_, counts_.missed);
            std::ofstream(arguments_.folder / (name + ".vtk")) << vtk_text(*mesh_, name);
            std::ofstream(arguments_.folder / (name + ".order"))
                << fmt::format("{}\n", fmt::join(order.back_to_front, "\n"));
        }
    }

    void report(const glm::dvec4& eye, const std::string& sorter, const Verdict& verdict, std::size_t count) const
    {
        if (count > arguments_.shown)
            return;
        fmt::print("{} {}: {}, eye {:.17g},{:.17g},{:.17g},{:.17g}: {}\n", kind_.name, number_, sorter, eye.x, eye.y,
                   eye.z, eye.w, verdict.words);
        if (!arguments_.folder.empty()) {
            const Mesh least = minimised(*mesh_, sorter, eye, verdict.what);
            const std::string name = fmt::format("{}_{}_{}_{}", kind_.name, number_, sorter, count);
            std::filesystem::create_directories(arguments_.folder);
            std::ofstream(arguments_.folder / (name + ".vtk")) << vtk_text(least, name);
            fmt::print("    {}.vtk, {} cells: {}\n", name, least.cell_count(), verdict_of(least, sorter, eye).words);
        }
        std::fflush(stdout);
    }

    const AuditKind& kind_;
    const Arguments& arguments_;
    Counts counts_;
    std::uint64_t number_ = 0;
    std::uint64_t view_ = 0; // of the scene
    const Mesh* mesh_ = nullptr;
    std::unique_ptr<OrderChecker> checker_;
};

int run(const Arguments& arguments)
{
    std::vector<Audit> audits;
    for (const AuditKind& kind : audit_kinds())
        if (contains(arguments.kinds, kind.name))
            audits.emplace_back(kind, arguments);
    Stopwatch watch;
    double seconds = 0;
    for (std::uint64_t i = 0; i < arguments.scenes && !audits.empty(); ++i) {
        seconds += watch.lap();
        if (arguments.seconds > 0 && seconds > arguments.seconds)
            break;
        audits[i % audits.size()].scene(arguments.first + i / audits.size());
    }
    fmt::print("\n{:<12} {:>8} {:>8} {:>9} {:>8} {:>12} {:>8}\n", "kind", "scenes", "views", "orders", "wrong",
               "false cycles", "refused");
    std::size_t wrong = 0, kind = 0;
    for (const AuditKind& of : audit_kinds())
        if (contains(arguments.kinds, of.name)) {
            const Counts& c = audits[kind++].counts();
            fmt::print("{:<12} {:>8} {:>8} {:>9} {:>8} {:>12} {:>8} {:>9} {:>8}   {}\n", of.name, c.scenes, c.views,
                       c.orders, c.wrong, c.false_cycles, c.refused, c.checked, c.missed, of.summary);
            wrong += c.wrong + c.false_cycles + c.missed;
        }
    return wrong > 0 ? 1 : 0;
}

} // namespace
} // namespace visorder::tests

int main(int argc, char** argv)
{
    visorder::tests::Arguments arguments;
    CLI::App app("Exact sorters against the truth on random small scenes of all hard kinds");
    app.add_option("--scenes", arguments.scenes, "Scenes in all, spread over the kinds")->capture_default_str();
    app.add_option("--first", arguments.first, "Number of the first scene of each kind")->capture_default_str();
    app.add_option("--kind", arguments.kinds, "Kinds, a,b,... (default: all)")->delimiter(',');
    app.add_option("--sorters", arguments.sorters, "Sorters, a,b,... (default: all that can be exact)")->delimiter(',');
    app.add_option("--write", arguments.folder, "A folder for the scenes of wrong orders, as .vtk");
    app.add_option("--seconds", arguments.seconds, "Begin no scene after this time")->capture_default_str();
    app.add_option("--rays", arguments.rays, "Rays of each view")->capture_default_str();
    app.add_option("--orders", arguments.orders, "Orders made to be wrong, of each view")->capture_default_str();
    app.add_option("--show", arguments.shown, "Wrong orders to show of each kind")->capture_default_str();
    std::signal(SIGABRT, visorder::tests::name_current_scene);
    std::signal(SIGSEGV, visorder::tests::name_current_scene);
    CLI11_PARSE(app, argc, argv);
    return visorder::tests::run(arguments);
}
