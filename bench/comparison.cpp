#include "bench/comparison.h"

#include "files/cell_numbers.h"
#include "files/crowded_faces.h"
#include "files/image_file.h"
#include "scene/boundary.h"
#include "scene/stopwatch.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/read_mesh.h"
#include "visorder/sorter_options.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

namespace visorder::bench {

using namespace detail;

using namespace scenes;

namespace {

using Progress = std::function<void(const std::string&)>;

struct Source {
    std::string name;  // unlike that of any other
    std::string title; // the same as a part of a file's name
    std::function<MeshFile()> read;
};

// The file's own name, or its whole path where another file has the same.
std::string distinct_name(const ComparisonOptions& options, const std::filesystem::path& file)
{
    const bool alone = std::none_of(options.files.begin(), options.files.end(), [&](const auto& other) {
        return other != file && other.filename() == file.filename();
    });
    return alone ? file.filename().string() : file.string();
}

std::vector<Source> sources_of(const ComparisonOptions& options)
{
    std::vector<Source> sources;
    for (const std::filesystem::path& file : options.files) {
        const ReadOptions read{.scalar = options.scalar,
                               .weld = options.weld,
                               .weld_tolerance = options.weld_tolerance,
                               .time = options.time};
        sources.push_back({distinct_name(options, file), "", [file, read] { return read_mesh(file, read); }});
    }
    for (const std::string& specification : options.generated)
        sources.push_back({specification, "", [specification] {
                               MeshFile result;
                               result.mesh = generate(specification);
                               return result;
                           }});
    const auto number_equals = [&](std::string Source::*member, const char* pattern) {
        std::set<std::string> taken;
        for (Source& source : sources) {
            const std::string first = source.*member;
            for (int number = 2; !taken.insert(source.*member).second; ++number)
                source.*member = fmt::format(fmt::runtime(pattern), first, number);
        }
    };
    number_equals(&Source::name, "{} ({})");
    for (Source& source : sources) {
        source.title = source.name;
        for (char& letter : source.title)
            if (std::string_view(":/() ").find(letter) != std::string_view::npos)
                letter = '-';
    }
    number_equals(&Source::title, "{}-{}");
    return sources;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

bool contains(std::span<const Structure> structures, Structure structure)
{
    return std::find(structures.begin(), structures.end(), structure) != structures.end();
}

// A sorter made for a scene, or why it cannot be.
struct Candidate {
    const SorterInfo* info;
    std::vector<Structure> structures; // that it needs on this scene
    std::unique_ptr<Sorter> sorter;
    double make_s = 0; // without the structures that the scene derived meanwhile
    std::string skipped;
};

const SorterInfo& info_of(std::string_view name)
{
    const auto known = sorters();
    return *std::find_if(known.begin(), known.end(), [&](const SorterInfo& info) { return name == info.name; });
}

// In a comparison of all sorters.
Candidate too_large_for(const SorterInfo& info)
{
    return {&info, {}, nullptr, 0, fmt::format("slow on more than {} cells; named in --sorters, it runs", info.up_to)};
}

Candidate make_candidate(const SorterInfo& info, const Scene& scene, const CellNumbers& cells,
                         const SorterOptions& options)
{
    Candidate candidate{&info, {info.structures.begin(), info.structures.end()}, nullptr, 0, {}};
    if (std::string_view(info.name) == "auto")
        for (Structure structure : info_of(choose_sorter(scene).name).structures)
            if (!contains(candidate.structures, structure))
                candidate.structures.push_back(structure);
    const std::size_t derived_before = scene.derived().size();
    Stopwatch watch;
    try {
        candidate.sorter = make_sorter(info.name, scene, options);
    } catch (const CellError& error) {
        candidate.skipped = cells.message(error);
        return candidate;
    } catch (const InputError& error) {
        candidate.skipped = error.what();
        return candidate;
    } catch (const GraphicsError& error) {
        candidate.skipped = error.what();
        return candidate;
    }
    candidate.make_s = watch.lap();
    const auto derived = scene.derived();
    for (std::size_t i = derived_before; i < derived.size(); ++i)
        candidate.make_s -= derived[i].seconds;
    candidate.make_s = std::max(candidate.make_s, 0.0);
    return candidate;
}

void measure(const Scene& scene, Candidate& candidate, const NamedView& view, int repeats, Order& order, RunResult& run)
{
    Sorter& sorter = *candidate.sorter;
    run.guarantee = sorter.guarantee();
    sorter.sort(view.view, order); // warms the sorter and the caches
    std::vector<double> seconds;
    for (int i = 0; i < repeats; ++i) {
        Stopwatch watch;
        sorter.sort(view.view, order);
        seconds.push_back(watch.lap());
    }
    run.sort_s = median(std::move(seconds));
    run.prepare_s = candidate.make_s;
    run.structure_bytes = sorter.bytes();
    run.statistics = sorter.statistics();
    for (const StructureRecord& record : scene.derived())
        if (contains(candidate.structures, record.structure)) {
            run.prepare_s += record.seconds;
            run.structure_bytes += record.bytes;
        }
    run.cycles = order.cycles.size();
    run.cells_in_cycles = std::transform_reduce(order.cycles.begin(), order.cycles.end(), std::size_t{0}, std::plus<>(),
                                                [](const auto& cycle) { return cycle.size(); });
}

std::unique_ptr<Frames> make_frames(const Scene& scene, const ComparisonOptions& options, SceneResult& description)
{
    if (options.frames == 0)
        return nullptr;
    if (options.images.empty() && scene.cell_count() > options.frames_up_to) {
        description.notes.push_back(
            fmt::format("no frames of more than {} cells, unless --images asks for them", options.frames_up_to));
        return nullptr;
    }
    try {
        return std::make_unique<Frames>(scene, options.sorter_options.layers.gl);
    } catch (const InputError& error) {
        description.notes.push_back(fmt::format("no frames: {}", error.what()));
    } catch (const GraphicsError& error) {
        description.notes.push_back(fmt::format("no frames: {}", error.what()));
    }
    return nullptr;
}

// The frames of one view, drawn in the orders of all sorters.
class ViewFrames {
public:
    void keep(Image image, const Order& order, RunResult& run)
    {
        if (exact_ == none && run.guarantee != Guarantee::approximate) {
            exact_ = drawn_.size();
            exact_order_ = order;
        }
        drawn_.push_back({std::move(image), &run});
    }

    // Draws the frame that all are held against, where none of the sorters is exact.
    void draw_exact(Frames& frames, const Scene& scene, const View& view)
    {
        if (exact_ != none)
            return;
        const auto sorter = make_sorter("auto", scene);
        if (sorter->guarantee() == Guarantee::approximate)
            return;
        sorter->sort(view, exact_order_);
        exact_ = drawn_.size();
        drawn_.push_back({frames.draw(view, exact_order_), nullptr});
    }

    void compare() const
    {
        for (const Drawn& drawn : drawn_)
            if (exact_ != none && drawn.run != nullptr) {
                const ImageErrors errors = image_errors(drawn.image, drawn_[exact_].image);
                drawn.run->image_rmse = errors.root_mean_square;
                drawn.run->image_max = errors.largest;
            }
    }

    // SCENE-VIEW-SORTER.png, and how it differs, amplified, where it does.
    void write(const std::filesystem::path& folder, const std::string& scene) const
    {
        std::filesystem::create_directories(folder);
        for (const Drawn& drawn : drawn_) {
            if (drawn.run == nullptr)
                continue;
            const std::string title = fmt::format("{}-view{}-{}", scene, drawn.run->view, drawn.run->sorter);
            write_png(drawn.image, folder / (title + ".png"));
            if (drawn.run->image_max.value_or(0) > 0)
                write_png(difference_image(drawn.image, drawn_[exact_].image, difference_amplification),
                          folder / (title + "-difference.png"), {.to_srgb = false});
        }
    }

    const Order* exact_order() const { return exact_ == none ? nullptr : &exact_order_; }

private:
    struct Drawn {
        Image image;
        RunResult* run; // none for a frame that belongs to no sorter of the comparison
    };
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    static constexpr double difference_amplification = 10;

    std::vector<Drawn> drawn_;
    std::size_t exact_ = none;
    Order exact_order_;
};

void compare_on(const Source& source, const ComparisonOptions& options, const Progress& progress, CellNumbers& cells,
                Comparison& result)
{
    progress(fmt::format("{}: making the scene", source.name));
    SceneResult description{source.name, 0, 0, false, false, 0, {}, false, {}};
    MeshFile file = source.read();
    description.notes = std::move(file.notes);
    cells = cell_numbers(file);
    if (options.subdivide) {
        Subdivision subdivision = subdivide(file.mesh);
        cells = cell_numbers(file, subdivision.cell_of);
        file.mesh = std::move(subdivision.mesh);
    }
    const Scene scene(std::move(file.mesh));
    auto views = random_views(scene, options.views, options.seed, options.size, options.up);
    if (options.hard_views)
        for (NamedView& view : hard_views(scene, options.size, options.up))
            views.push_back(std::move(view));

    std::vector<Candidate> candidates;
    for (const SorterInfo& info : sorters())
        if (options.sorters.empty() ||
            std::find(options.sorters.begin(), options.sorters.end(), info.name) != options.sorters.end()) {
            progress(fmt::format("{}: preparing {}", source.name, info.name));
            candidates.push_back(options.sorters.empty() && scene.cell_count() > info.up_to
                                     ? too_large_for(info)
                                     : make_candidate(info, scene, cells, options.sorter_options));
        }

    progress(fmt::format("{}: traits", source.name));
    const OrderChecker checker(scene);
    description.cells = scene.cell_count();
    description.surface = scene.is_surface();
    description.boundary_faces = scene.boundary().faces.size();
    description.convex = scene.traits().convex;
    description.delaunay = scene.traits().delaunay;

    if (const std::string note = crowded_faces_note(scene, cells); !note.empty())
        description.notes.push_back(note);
    const std::unique_ptr<Frames> frames = make_frames(scene, options, description);
    if (frames != nullptr)
        result.gl_renderer = frames->gl_renderer();

    // View by view, so that the relations of each are found once; the runs are put sorter by sorter.
    std::vector<std::vector<RunResult>> runs(candidates.size(), std::vector<RunResult>(views.size()));
    Order order;
    for (std::size_t v = 0; v < views.size(); ++v) {
        progress(fmt::format("{}: view {} of {}, relations", source.name, v + 1, views.size()));
        const Relations relations = checker.relations_at(views[v].view.eye);
        std::optional<RayAudit> audit;
        if (options.audit_rays > 0) {
            progress(fmt::format("{}: view {} of {}, rays", source.name, v + 1, views.size()));
            audit.emplace(scene, views[v].view.eye, RayAuditOptions{options.audit_rays, options.seed + v});
        }
        ViewFrames view_frames;
        const bool draws = frames != nullptr && v < static_cast<std::size_t>(options.frames);
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            Candidate& candidate = candidates[c];
            RunResult& run = runs[c][v];
            run.scene = source.name;
            run.view = static_cast<int>(v);
            run.view_name = views[v].name;
            run.sorter = candidate.info->name;
            run.skipped = candidate.skipped;
            if (!candidate.skipped.empty())
                continue;
            progress(fmt::format("{}: view {} of {}, {}", source.name, v + 1, views.size(), candidate.info->name));
            measure(scene, candidate, views[v], options.repeats, order, run);
            const CheckResult checked = checker.check(relations, order);
            run.relations = checked.relations;
            run.violations = checked.violations;
            run.violations_in_cycles = checked.violations_in_cycles;
            description.overlapping_pairs = checked.overlapping.size();
            if (audit) {
                const RayAuditResult shown = audit->check(order, checked.unorderable);
                run.audit_rays = shown.rays;
                run.audit_pairs = shown.pairs;
                run.audit_violations = shown.violations;
            }
            if (draws)
                view_frames.keep(frames->draw(views[v].view, order), order, run);
        }
        if (!draws)
            continue;
        progress(fmt::format("{}: view {} of {}, frames", source.name, v + 1, views.size()));
        view_frames.draw_exact(*frames, scene, views[v].view);
        view_frames.compare();
        if (!options.images.empty())
            view_frames.write(options.images, source.title);
        if (v == 0 && view_frames.exact_order() != nullptr)
            description.integrators = frames->integrators(views[v].view, *view_frames.exact_order());
    }
    result.scenes.push_back(std::move(description));
    for (auto& of_sorter : runs)
        std::move(of_sorter.begin(), of_sorter.end(), std::back_inserter(result.runs));
}

void require_known(const std::vector<std::string>& names)
{
    for (const std::string& name : names) {
        const auto known = sorters();
        if (std::none_of(known.begin(), known.end(), [&](const SorterInfo& info) { return name == info.name; })) {
            std::string all;
            for (const SorterInfo& info : known)
                all += fmt::format("{}{}", all.empty() ? "" : ", ", info.name);
            throw InputError(fmt::format("no sorter \"{}\"; there are: {}", name, all));
        }
    }
}

} // namespace

bool Comparison::failed() const
{
    return std::any_of(runs.begin(), runs.end(), [](const RunResult& run) { return run.failed(); });
}

Comparison compare(const ComparisonOptions& options, const Progress& progress)
{
    require_known(options.sorters);
    Comparison result;
    for (const Source& source : sources_of(options)) {
        CellNumbers cells({}, {});
        try {
            compare_on(source, options, progress, cells, result);
        } catch (const CellError& error) {
            result.refused.push_back({source.name, fmt::format("{}: {}", source.name, cells.message(error))});
        } catch (const InputError& error) {
            const std::string what = error.what();
            const bool names_it = what.find(source.name) != std::string::npos;
            result.refused.push_back({source.name, names_it ? what : fmt::format("{}: {}", source.name, what)});
        } catch (const std::bad_alloc&) {
            result.refused.push_back({source.name, fmt::format("{}: not enough memory", source.name)});
        }
    }
    return result;
}

} // namespace visorder::bench
