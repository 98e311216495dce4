#include "apps/commands.h"
#include "apps/image_size.h"
#include "apps/output_file.h"
#include "apps/progress.h"
#include "apps/scene_source.h"
#include "apps/view_choice.h"
#include "bench/layer_pictures.h"
#include "bench/layer_truth.h"
#include "layering/layers_sorter.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

namespace visorder::apps {

using namespace detail;

using namespace bench;

namespace {

struct Arguments {
    std::shared_ptr<SceneSource> source;
    std::vector<std::string> sizes{"256x256", "512x512"};
    std::vector<double> up;
    int frames = 30;
    int block = 64;
    std::string gl = "auto";
    std::string folder;
    bool check = false;
};

struct Variant {
    const char* name;
    LayerVariant variant;
};
constexpr std::array variants{Variant{"layers", LayerVariant::naive}, Variant{"layers-blocked", LayerVariant::blocked},
                              Variant{"layers-compute", LayerVariant::compute}};

// A surface, and what its triangles are called.
struct NamedSurface {
    Mesh mesh;
    CellNumbers cells;
};

// The mesh itself if it is a surface, else its boundary, whose triangles are parts of the cells that they bound.
NamedSurface surface_of(SourcedMesh& sourced)
{
    if (sourced.mesh.shapes.empty() || sourced.mesh.shapes.front() == CellShape::triangle)
        return {std::move(sourced.mesh), sourced.cells};
    const Scene scene(std::move(sourced.mesh));
    std::vector<std::pair<CellId, FaceLoop>> triangles; // the caller's cell
    for (const CellFace& face : scene.boundary().faces) {
        const FaceLoop loop = boundary_loop(scene.mesh(), face);
        for (int i = 2; i < loop.count; ++i)
            triangles.push_back(
                {scene.caller_cells()[face.cell], {{loop.begin()[0], loop.begin()[i - 1], loop.begin()[i]}, 3}});
    }
    std::stable_sort(triangles.begin(), triangles.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Mesh surface;
    surface.points = scene.mesh().points;
    std::vector<std::uint64_t> file_cells;
    for (const auto& [cell, loop] : triangles) {
        surface.add(CellShape::triangle, std::span(loop.begin(), 3));
        file_cells.push_back(sourced.cells.file_cells()[cell]);
    }
    return {std::move(surface), {std::move(file_cells), sourced.cells.blocks()}};
}

std::size_t used_points(const Mesh& mesh)
{
    std::vector<std::uint32_t> used = mesh.vertices;
    std::sort(used.begin(), used.end());
    return static_cast<std::size_t>(std::unique(used.begin(), used.end()) - used.begin());
}

// Once around the scene, a little from above.
View frame_view(const Scene& scene, const Upright& upright, double turns, glm::ivec2 size)
{
    const glm::dvec3 middle = scene.bounds().middle();
    const double half = glm::length(scene.bounds().max * 0.5 - scene.bounds().min * 0.5);
    const double radius = half > 0 ? half : 1;
    const double angle = 2 * std::numbers::pi * turns;
    const ViewAxes axes = view_axes(upright.up);
    const glm::dvec3 direction =
        glm::normalize(std::sin(angle) * axes.right + 0.35 * axes.up + std::cos(angle) * axes.front);
    return look_at(middle + 4.2 * radius * direction, middle, radius, 27, size, upright);
}

struct Frames {
    LayerWork work; // of all frames
    double layers = 0;
    double unproven = 0;
    std::vector<Layers> of_frames;
};

Frames run_frames(const Scene& scene, const Upright& upright, LayersSorter& sorter, glm::ivec2 size, int count)
{
    Frames frames;
    Order order;
    sorter.sort(frame_view(scene, upright, 0, size), order); // warms the renderer and the caches
    for (int i = 0; i < count; ++i) {
        sorter.sort(frame_view(scene, upright, static_cast<double>(i) / count, size), order);
        const LayerWork& work = sorter.work();
        frames.work.rendering_s += work.rendering_s;
        frames.work.reading_s += work.reading_s;
        frames.work.scanning_s += work.scanning_s;
        frames.work.rest_s += work.rest_s;
        frames.work.passes += work.passes;
        frames.work.pixels_read += work.pixels_read;
        frames.work.flags_read += work.flags_read;
        frames.work.fragments_read += work.fragments_read;
        frames.layers += sorter.layers().count;
        frames.unproven += static_cast<double>(sorter.layers().unproven.size());
        frames.of_frames.push_back(sorter.layers());
    }
    return frames;
}

bool same(const Layers& a, const Layers& b)
{
    return a.layer == b.layer && a.cycles == b.cycles && a.unproven.size() == b.unproven.size();
}

// Holds the frames of one variant on one platform against the truth; the others must be equal to it.
bool check_frames(const Scene& scene, const NamedSurface& surface, const Arguments& arguments, glm::ivec2 size,
                  Progress& progress)
{
    const Upright upright = upright_of(arguments.up, scene);
    std::vector<Layers> expected;
    bool right = true;
    for (const GlPlatform platform : {GlPlatform::egl, GlPlatform::osmesa})
        for (const Variant& variant : variants)
            for (const int block : {32, 64, 128}) {
                if (variant.variant != LayerVariant::blocked && block != 64)
                    continue;
                progress.show(fmt::format("{} x {}, {} on {}", size.x, size.y, variant.name, name(platform)));
                LayersSorter sorter(scene, variant.variant, platform, size, block);
                Frames frames = run_frames(scene, upright, sorter, size, arguments.frames);
                if (expected.empty())
                    expected = std::move(frames.of_frames);
                else if (!std::equal(expected.begin(), expected.end(), frames.of_frames.begin(), same)) {
                    fmt::print("  {} x {}: {} on {} gives other layers, with blocks of {}\n", size.x, size.y,
                               variant.name, name(platform), block);
                    right = false;
                }
            }
    LayerCheck sum;
    for (int i = 0; i < arguments.frames; ++i) {
        progress.show(fmt::format("{} x {}, truth of frame {}", size.x, size.y, i + 1));
        const LayerCheck check = check_layers(
            surface.mesh, frame_view(scene, upright, static_cast<double>(i) / arguments.frames, size), size,
            expected[static_cast<std::size_t>(i)], [&](CellId triangle) { return surface.cells.name(triangle); });
        sum.samples += check.samples;
        sum.fragments += check.fragments;
        sum.pairs += check.pairs;
        sum.ties += check.ties;
        sum.in_cycles += check.in_cycles;
        sum.wrong += check.wrong;
        sum.missed += check.missed;
        for (const std::string& witness : check.witnesses)
            fmt::print("  frame {}: {}\n", i + 1, witness);
    }
    fmt::print("  {} x {}: {} pairs at {} sample points, {} wrong, {} missed; not compared: {} in cycles, {} ties\n",
               size.x, size.y, sum.pairs, sum.samples, sum.wrong, sum.missed, sum.in_cycles, sum.ties);
    return right && sum.wrong == 0 && sum.missed == 0;
}

int run(const Arguments& arguments)
{
    std::vector<glm::ivec2> sizes;
    for (const std::string& text : arguments.sizes)
        sizes.push_back(image_size(text, "--size"));
    const GlPlatform platform = gl_platform(arguments.gl);
    require_writable_folder(arguments.folder);
    SourcedMesh sourced = load(*arguments.source);
    const NamedSurface surface = surface_of(sourced);
    const Mesh& mesh = surface.mesh;
    const Scene scene(mesh);
    const Upright upright = upright_of(arguments.up, scene);

    Progress progress;
    std::string depths, work;
    std::string renderer;
    for (const glm::ivec2 size : sizes)
        for (const Variant& variant : variants) {
            progress.show(fmt::format("{} x {}, {}", size.x, size.y, variant.name));
            LayersSorter sorter(scene, variant.variant, platform, size, arguments.block);
            const Frames frames = run_frames(scene, upright, sorter, size, arguments.frames);
            renderer = sorter.context().renderer();
            const double count = arguments.frames;
            if (variant.variant == LayerVariant::naive)
                depths += fmt::format(" {:>15}",
                                      fmt::format("{:.1f} ({:.0f})", frames.layers / count, frames.unproven / count));
            const double total = frames.work.total_s();
            work += fmt::format(
                "{:>11}  {:<14} {:>9.2f} {:>9.1f} {:>8.1f} {:>9.1f} {:>6.1f} {:>8.1f} {:>11.0f} {:>8.0f} "
                "{:>10.0f}\n",
                fmt::format("{}x{}", size.x, size.y), variant.name, 1e3 * total / count,
                100 * frames.work.rendering_s / total, 100 * frames.work.reading_s / total,
                100 * frames.work.scanning_s / total, 100 * frames.work.rest_s / total,
                static_cast<double>(frames.work.passes) / count, static_cast<double>(frames.work.pixels_read) / count,
                static_cast<double>(frames.work.flags_read) / count,
                static_cast<double>(frames.work.fragments_read) / count);
        }
    progress.show("pictures");
    LayersSorter sorter(scene, LayerVariant::blocked, platform, sizes.back(), arguments.block);
    const std::uint32_t pictures =
        write_layer_pictures(mesh, sorter, frame_view(scene, upright, 0.08, sizes.back()),
                             frame_view(scene, upright, 0.58, sizes.back()), arguments.folder);

    std::string header;
    for (const glm::ivec2 size : sizes)
        header += fmt::format(" {:>15}", fmt::format("{}x{}", size.x, size.y));
    fmt::print("{}; means over {} frames once around; blocks of {} pixels\n\n", renderer, arguments.frames,
               arguments.block);
    fmt::print("{:<24} {:>9} {:>10} {}\n{:<24} {:>9} {:>10} {}\n\n", "depth (without proof)", "vertices", "triangles",
               header, sourced.name, used_points(mesh), mesh.cell_count(), depths);
    fmt::print("{:>11}  {:<14} {:>9} {:>9} {:>8} {:>9} {:>6} {:>8} {:>11} {:>8} {:>10}\n{}\n", "image", "variant",
               "ms/frame", "render %", "read %", "scan %", "rest %", "passes", "pixels read", "flags", "fragments",
               work);
    fmt::print("{}: layers.png, turned.png and {} layers alone\n", arguments.folder, pictures);
    if (!arguments.check)
        return exit_success;
    fmt::print("\nagainst depths in double precision, all variants on EGL and OSMesa:\n");
    bool right = true;
    for (const glm::ivec2 size : sizes)
        right = check_frames(scene, surface, arguments, size, progress) && right;
    return right ? exit_success : exit_wrong;
}

} // namespace

void add_layers_command(CLI::App& app, Command& chosen)
{
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "layers", "Extract the layers of a surface, or of a boundary: what it costs, how deep it is, and pictures");
    arguments->source = add_scene_source(*command);
    command->add_option("--size", arguments->sizes, "Pixels of the images, WxH,WxH,... (default: 256x256,512x512)")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_up_option(*command, arguments->up);
    command->add_option("--frames", arguments->frames, "Views, once around the model")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_option("--block", arguments->block, "Pixels of a block's side")
        ->capture_default_str()
        ->check(CLI::IsMember({32, 64, 128}));
    command->add_option("--gl", arguments->gl, "Where OpenGL comes from")
        ->capture_default_str()
        ->check(CLI::IsMember({"auto", "egl", "osmesa"}));
    command->add_flag("--check", arguments->check,
                      "Also hold every sample point against depths computed in double precision; exit code 1 if wrong");
    command->add_option("-o,--output", arguments->folder, "The folder of the pictures")->required();
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
