#include "apps/commands.h"
#include "apps/image_size.h"
#include "apps/missing_scalars.h"
#include "apps/number_check.h"
#include "apps/output_file.h"
#include "apps/scene_source.h"
#include "apps/sorter_options.h"
#include "apps/view_choice.h"
#include "bench/image_file.h"
#include "graphics/context.h"
#include "projection/renderer.h"
#include "projection/transfer_function_file.h"
#include "scene/error.h"
#include "scene/scalar_interval.h"
#include "sorting/registry.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace visorder::apps {

using namespace bench;

namespace {

struct Arguments {
    std::shared_ptr<SceneSource> source;
    std::shared_ptr<ViewChoice> view;
    std::string sorter = "auto";
    SorterOptions sorter_options;
    std::string projector = name(RenderOptions{}.projector);
    std::string integrator = name(RenderOptions{}.integrator);
    std::string transfer = "cool-warm";
    std::string map;
    std::string nan = "drop";
    double unit_length = 0;
    std::vector<double> camera;
    double view_angle = 30;
    std::string size = "512x512";
    int blending_bits = RenderOptions{}.blending_bits;
    std::size_t table_scalars = 0;
    std::size_t table_lengths = TableOptions{}.lengths;
    bool even_lengths = false;
    std::vector<float> background{1, 1, 1};
    std::string output;
};

// The ending says which kind of file; standard output gets a PNG.
bool is_exr(const std::filesystem::path& file)
{
    const std::string ending = small_ending(file);
    if (ending == ".exr")
        return true;
    if (ending != ".png" && !is_standard_output(file))
        throw InputError(fmt::format("{}: a picture's name ends in .png or .exr", file.string()));
    return false;
}

View chosen_view(const Arguments& arguments, const Scene& scene)
{
    const glm::ivec2 size = image_size(arguments.size, "--size");
    if (arguments.camera.empty())
        return view_of(*arguments.view, scene, size, arguments.view_angle);
    const std::vector<double>& c = arguments.camera;
    Camera camera;
    camera.position = {c[0], c[1], c[2]};
    camera.focal_point = {c[3], c[4], c[5]};
    camera.up = {c[6], c[7], c[8]};
    camera.view_angle = arguments.view_angle;
    // Near and far plane clip nothing here, but must be somewhere.
    const double distance = glm::length(camera.focal_point - camera.position);
    camera.near = 1e-3 * distance;
    camera.far = 1e3 * distance;
    return view_of(camera, size);
}

// A function of a file's scalars, over the scalars that the mesh has for them.
TransferFunction stored(const TransferFunction& of_values, const ScalarMap& map)
{
    std::vector<OpticalPoint> points(of_values.points().begin(), of_values.points().end());
    for (OpticalPoint& point : points)
        point.scalar = map.stored(point.scalar);
    return TransferFunction(std::move(points));
}

TransferFunction chosen_function(const Arguments& arguments, const Scene& scene, const ScalarMap& map)
{
    const auto names = transfer_function_names();
    const double unit_length = arguments.unit_length != 0 ? arguments.unit_length : scene.diameter() / 10;
    if (std::find(names.begin(), names.end(), arguments.transfer) == names.end()) {
        if (!std::filesystem::exists(arguments.transfer))
            throw InputError(fmt::format("{}: neither a file nor a transfer function; there are: {}",
                                         arguments.transfer, fmt::join(names, ", ")));
        std::optional<ScalarInterval> scalars = scalar_interval(scene.mesh());
        if (scalars)
            scalars = {map.value(scalars->lowest), map.value(scalars->highest)};
        return stored(read_transfer_function(arguments.transfer, {unit_length, arguments.map, scalars}), map);
    }
    const std::optional<ScalarInterval> scalars = scalar_interval(scene.mesh());
    // What a function has at its lowest scalar is mostly nothing.
    const bool all_equal = scalars && scalars->lowest == scalars->highest;
    return named_transfer_function(all_equal ? "constant" : arguments.transfer, scene, unit_length);
}

// What a picture with nothing in it is for want of; empty if there is something in it.
std::string blank_because(const Image& image, const Scene& scene, const TransferFunction& function)
{
    if (std::any_of(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& pixel) { return pixel.w != 0; }))
        return {};
    const auto is_opaque = [&](double scalar) { return function.at(scalar).extinction > 0; };
    const auto& scalars = scene.mesh().scalars;
    const auto& points = function.points();
    const std::optional<ScalarInterval> range = scalar_interval(scene.mesh());
    const bool some_opacity =
        std::any_of(scalars.begin(), scalars.end(), [&](float scalar) { return is_opaque(scalar); }) ||
        std::any_of(points.begin(), points.end(), [&](const OpticalPoint& point) {
            return point.extinction > 0 && range && point.scalar >= range->lowest && point.scalar <= range->highest;
        });
    return some_opacity ? "the view shows nothing of the scene"
                        : "the transfer function is transparent over all scalars of the mesh";
}

int run(const Arguments& arguments, SourcedMesh& sourced)
{
    const bool exr = is_exr(arguments.output);
    RenderOptions options;
    options.projector = projector_named(arguments.projector);
    options.integrator = integrator_named(arguments.integrator);
    options.blending_bits = arguments.blending_bits;
    options.tables = {arguments.table_scalars, arguments.table_lengths, !arguments.even_lengths};
    const GlPlatform platform = gl_platform(arguments.sorter_options.gl);

    const bool without_scalars = sourced.mesh.scalars.empty();
    if (without_scalars)
        sourced.mesh.scalars.assign(sourced.mesh.points.size(), 0.0f);
    const std::size_t dropped = settle_missing_scalars(sourced, arguments.nan);
    const Scene scene(std::move(sourced.mesh));
    const View view = chosen_view(arguments, scene);
    const TransferFunction function = chosen_function(arguments, scene, sourced.scalar_map);
    const Context context(platform);
    ProjectionRenderer renderer(context, scene, function, options);
    const auto sorter = make_sorter(arguments.sorter, scene, arguments.sorter_options);
    Order order;
    sorter->sort(view, order);
    const Image image = renderer.draw(view, order);
    const PngStyle style{{arguments.background[0], arguments.background[1], arguments.background[2]}, true};
    write_file(arguments.output, exr ? exr_of(image) : png_of(image, style));
    const RenderStatistics& taken = renderer.statistics();
    fmt::print(message_stream({arguments.output}),
               "{}: {} x {}, {} cells as {} triangles in {:.3f} s by {} and {} on {}; sorted by {} ({})\n",
               arguments.output, image.size.x, image.size.y, scene.cell_count(), taken.triangles,
               taken.place_s + taken.draw_s + taken.read_s, name(options.projector), name(options.integrator),
               context.renderer(), named_sorter(arguments.sorter, scene), describe(sorter->guarantee(), scene));
    if (const std::string reason = blank_because(image, scene, function); !reason.empty())
        fmt::print(message_stream({arguments.output}), "{}: 0 of {} cells are visible: {}\n", arguments.output,
                   scene.cell_count(), reason);
    if (without_scalars)
        fmt::print(message_stream({arguments.output}), "{}: the mesh has no scalars: all of it is drawn alike\n",
                   arguments.output);
    if (dropped > 0)
        fmt::print(message_stream({arguments.output}),
                   "{}: {} of {} cells are left out of the picture, for a scalar of theirs is missing (--nan)\n",
                   arguments.output, dropped, scene.cell_count() + dropped);
    tell_faults(message_stream({arguments.output}), sourced, scene);
    return exit_success;
}

int run(const Arguments& arguments)
{
    is_exr(arguments.output);
    require_writable(arguments.output);
    SourcedMesh sourced = load(*arguments.source);
    return with_names_of(sourced, [&] { return run(arguments, sourced); });
}

} // namespace

void add_render_command(CLI::App& app, Command& chosen)
{
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("render", "Draw a mesh of tetrahedra as a volume, in a sorter's order");
    arguments->source = add_scene_source(*command);
    arguments->view = add_view_choice(*command);
    command
        ->add_option("--camera", arguments->camera,
                     "Position, focal point and up vector of a perspective camera, nine numbers with commas between")
        ->delimiter(',')
        ->expected(9)
        ->allow_extra_args(false)
        ->excludes("--eye")
        ->excludes("--direction");
    command->add_option("--view-angle", arguments->view_angle, "Vertical, in degrees, of a perspective view")
        ->capture_default_str()
        ->check(between(0.001, 179.999));
    command->add_option("--size", arguments->size, "Pixels, WxH")->capture_default_str();
    command->add_option("--sorter", arguments->sorter, "Which one; `visorder sorters` lists them")
        ->capture_default_str();
    add_sorter_options(*command, arguments->sorter_options);
    command->add_option("--projector", arguments->projector, "How cells become triangles")->capture_default_str();
    command
        ->add_option("--integrator", arguments->integrator,
                     "linear, exponential, preintegrated-2d, preintegrated-3d or exact")
        ->capture_default_str();
    command
        ->add_option("--transfer", arguments->transfer,
                     fmt::format("Transfer function: a JSON file, visorder's or ParaView's, or one of {}",
                                 fmt::join(transfer_function_names(), ", ")))
        ->capture_default_str();
    command
        ->add_option("--nan", arguments->nan,
                     "Cells with a scalar that is missing: drop them, take the lowest scalar, or refuse")
        ->capture_default_str()
        ->check(CLI::IsMember({"drop", "lowest", "refuse"}));
    command->add_option("--map", arguments->map, "The colour map to take from a ParaView file of several");
    command
        ->add_option("--unit-length", arguments->unit_length,
                     "The distance over which opacities hold (default: a tenth of the scene's diameter)")
        ->check(positive());
    command->add_option("--blending", arguments->blending_bits, "Bits of a channel: 32 or 16 (floats), or 8")
        ->capture_default_str();
    command
        ->add_option("--table-scalars", arguments->table_scalars,
                     "Entries of a table along each scalar (default: 1024 in 2D, 256 in 3D)")
        ->check(count_from(1));
    command->add_option("--table-lengths", arguments->table_lengths, "Entries of a 3D table along the length")
        ->capture_default_str()
        ->check(count_from(1));
    command->add_flag("--even-lengths", arguments->even_lengths,
                      "Space the entries along the length evenly, not as 1 - 2^-length");
    command->add_option("--background", arguments->background, "Of a PNG, three linear numbers in [0, 1]")
        ->delimiter(',')
        ->expected(3)
        ->allow_extra_args(false)
        ->check(between(0, 1));
    command
        ->add_option("-o,--output", arguments->output, "Where to: .png, or .exr for the floats; - for standard output")
        ->required();
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
