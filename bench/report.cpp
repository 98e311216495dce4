#include "bench/report.h"

#include "graphics/context.h"
#include "parallel/concurrency.h"
#include "visorder/version.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

namespace visorder::bench {

using namespace detail;

namespace {

// The runs of one sorter on one scene.
struct Row {
    const RunResult* first;
    std::vector<double> sort_s;
    std::size_t relations = 0;
    std::size_t violations = 0;
    std::size_t violations_in_cycles = 0;
    std::size_t audit_pairs = 0;
    std::size_t audit_violations = 0;
    std::size_t cycles = 0;
    std::size_t cells_in_cycles = 0;
    std::size_t bytes = 0;
    double image_rmse = -1;
    bool failed = false;
};

std::vector<Row> rows_of(const Comparison& comparison)
{
    std::vector<Row> rows;
    for (const RunResult& run : comparison.runs) {
        if (rows.empty() || rows.back().first->scene != run.scene || rows.back().first->sorter != run.sorter) {
            rows.emplace_back();
            rows.back().first = &run;
        }
        Row& row = rows.back();
        row.sort_s.push_back(run.sort_s);
        row.relations += run.relations;
        row.violations += run.violations;
        row.violations_in_cycles += run.violations_in_cycles;
        row.audit_pairs += run.audit_pairs;
        row.audit_violations += run.audit_violations;
        row.cycles += run.cycles;
        row.cells_in_cycles += run.cells_in_cycles;
        row.bytes = std::max(row.bytes, run.structure_bytes);
        row.image_rmse = std::max(row.image_rmse, run.image_rmse.value_or(-1));
        row.failed = row.failed || run.failed();
    }
    return rows;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::string with_commas(std::size_t n)
{
    std::string digits = fmt::format("{}", n);
    for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

std::string seconds(double s)
{
    return s < 0.001 ? fmt::format("{:.1f} us", s * 1e6)
           : s < 1   ? fmt::format("{:.2f} ms", s * 1e3)
                     : fmt::format("{:.2f} s", s);
}

const SceneResult& scene_of(const Comparison& comparison, const std::string& name)
{
    return *std::find_if(comparison.scenes.begin(), comparison.scenes.end(),
                         [&](const SceneResult& scene) { return scene.name == name; });
}

std::string traits_of(const SceneResult& scene)
{
    std::string text = scene.surface ? "surface" : scene.convex ? "convex" : "not convex";
    if (scene.delaunay)
        text += ", Delaunay";
    if (scene.overlapping_pairs > 0)
        text += fmt::format(", {} pairs of cells overlap, for which no order is exact",
                            with_commas(scene.overlapping_pairs));
    return text;
}

// What the integrators make of a scene.
std::string integrators_of(const SceneResult& scene)
{
    std::string text;
    for (const IntegratorResult& result : scene.integrators)
        text += fmt::format("  drawn by {:<17} rmse {:.2e}, at most {:.2e} from the ray caster's; {} a frame\n",
                            result.integrator, result.errors.root_mean_square, result.errors.largest,
                            seconds(result.seconds));
    return text;
}

std::string line_of(const Row& row, std::size_t cells)
{
    const RunResult& run = *row.first;
    if (!run.skipped.empty())
        return fmt::format("  {:<16} skipped: {}", run.sorter, run.skipped);
    const double sort_s = median(row.sort_s);
    std::string cycles =
        row.cycles == 0 ? "0" : fmt::format("{} ({} cells)", row.cycles, with_commas(row.cells_in_cycles));
    if (row.violations_in_cycles > 0)
        cycles += fmt::format(", {} broken in them", with_commas(row.violations_in_cycles));
    if (run.audit_rays > 0)
        cycles += fmt::format("; rays: {} wrong of {} pairs", with_commas(row.audit_violations),
                              with_commas(row.audit_pairs));
    return fmt::format("  {:<16} {:<11} {:>10} {:>10} {:>8.1f} {:>8.1f}  {:>11} of {:<13} {:>8}   {}", run.sorter,
                       name(run.guarantee), seconds(run.prepare_s), seconds(sort_s),
                       static_cast<double>(cells) / sort_s / 1e6, static_cast<double>(row.bytes) / 0x1p20,
                       with_commas(row.violations), with_commas(row.relations),
                       row.image_rmse < 0 ? "-" : fmt::format("{:.2e}", row.image_rmse), cycles);
}

// Those of all runs of a sorter on a scene, of which `first` is one.
std::string statistics_of(const Comparison& comparison, const RunResult& first)
{
    std::string text;
    for (std::size_t i = 0; i < first.statistics.size(); ++i) {
        std::vector<double> values, shares;
        for (const RunResult& run : comparison.runs)
            if (run.scene == first.scene && run.sorter == first.sorter) {
                const Statistic& statistic = run.statistics[i];
                values.push_back(statistic.value);
                shares.push_back(statistic.whole > 0 ? 100 * statistic.value / statistic.whole : 0);
            }
        const double value = median(std::move(values));
        const bool is_count = value >= 0 && value < 1e15 && value == std::floor(value);
        text += fmt::format("  {:<16}   {:<44} {:>15}", "", first.statistics[i].name,
                            is_count ? with_commas(static_cast<std::size_t>(value)) : fmt::format("{:.6g}", value));
        if (first.statistics[i].whole > 0)
            text += fmt::format(" {:>8.3f} %", median(std::move(shares)));
        text += '\n';
    }
    return text;
}

template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value)
{
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

} // namespace

Machine this_machine()
{
    Machine machine{"unknown", static_cast<int>(concurrency()), "none"};
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) {
            machine.cpu = line.substr(line.find(':') + 2);
            break;
        }
    try {
        machine.gl_renderer = Context().renderer();
    } catch (const GraphicsError&) {
        machine.gl_renderer = "none";
    }
    return machine;
}

std::string table(const Comparison& comparison, bool colour, bool statistics)
{
    std::string text =
        fmt::format("  {:<16} {:<11} {:>10} {:>10} {:>8} {:>8}  {:>11} of {:<13} {:>8}   {}\n", "sorter", "guarantee",
                    "prepare", "sort", "Mcells/s", "MiB", "violations", "relations", "rmse", "cycles");
    const SceneResult* scene = nullptr;
    for (const Row& row : rows_of(comparison)) {
        const SceneResult& of_row = scene_of(comparison, row.first->scene);
        if (&of_row != scene) {
            scene = &of_row;
            text +=
                fmt::format("\n{}: {} cells, {} boundary {}, {}\n", scene->name, with_commas(scene->cells),
                            with_commas(scene->boundary_faces), scene->surface ? "edges" : "faces", traits_of(*scene));
            for (const std::string& note : scene->notes)
                text += fmt::format("  ({})\n", note);
            text += integrators_of(*scene);
        }
        const std::string line = line_of(row, scene->cells);
        text += row.failed && colour ? fmt::format("\033[31m{}   BROKEN GUARANTEE\033[0m\n", line)
                : row.failed         ? fmt::format("{}   BROKEN GUARANTEE\n", line)
                                     : line + "\n";
        if (statistics)
            text += statistics_of(comparison, *row.first);
    }
    return text;
}

std::string json(const Comparison& comparison, const Machine& machine)
{
    using Json = nlohmann::ordered_json;
    Json document{
        {"visorder", version},
        {"machine", {{"cpu", machine.cpu}, {"threads", machine.threads}, {"gl_renderer", machine.gl_renderer}}},
        {"scenes", Json::array()},
        {"runs", Json::array()}};
    for (const SceneResult& scene : comparison.scenes) {
        Json entry{{"name", scene.name},
                   {"cells", scene.cells},
                   {"surface", scene.surface},
                   {"boundary_faces", scene.boundary_faces},
                   {"convex", scene.convex},
                   {"delaunay", scene.delaunay},
                   {"overlapping_pairs", scene.overlapping_pairs},
                   {"integrators", Json::array()}};
        for (const IntegratorResult& result : scene.integrators)
            entry["integrators"].push_back({{"integrator", result.integrator},
                                            {"rmse", result.errors.root_mean_square},
                                            {"max", result.errors.largest},
                                            {"frame_s", result.seconds}});
        document["scenes"].push_back(std::move(entry));
    }
    for (const RunResult& run : comparison.runs) {
        Json entry{{"scene", run.scene}, {"view", run.view}, {"view_name", run.view_name}, {"sorter", run.sorter}};
        if (!run.skipped.empty()) {
            entry["skipped"] = run.skipped;
        } else {
            entry["guarantee"] = describe(run.guarantee, scene_of(comparison, run.scene).overlapping_pairs);
            entry["prepare_s"] = run.prepare_s;
            entry["sort_s"] = run.sort_s;
            entry["structure_bytes"] = run.structure_bytes;
            entry["relations"] = run.relations;
            entry["violations"] = run.violations;
            entry["violations_in_cycles"] = run.violations_in_cycles;
            entry["audit_rays"] = run.audit_rays;
            entry["audit_pairs"] = run.audit_pairs;
            entry["audit_violations"] = run.audit_violations;
            entry["cycles"] = run.cycles;
            entry["cells_in_cycles"] = run.cells_in_cycles;
            entry["image_rmse"] = or_null(run.image_rmse);
            entry["image_max"] = or_null(run.image_max);
            entry["statistics"] = Json::object();
            for (const Statistic& statistic : run.statistics)
                entry["statistics"][statistic.name] = statistic.value;
        }
        document["runs"].push_back(std::move(entry));
    }
    if (!comparison.refused.empty()) {
        document["refused"] = Json::array();
        for (const Refusal& refusal : comparison.refused)
            document["refused"].push_back({{"source", refusal.source}, {"reason", refusal.reason}});
    }
    return document.dump(2) + "\n";
}

} // namespace visorder::bench
