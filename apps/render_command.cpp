#include "apps/commands.h"
#include "apps/image_size.h"
#include "apps/missing_scalars.h"
#include "apps/number_check.h"
#include "apps/output_file.h"
#include "apps/scene_source.h"
#include "apps/sorter_options.h"
#include "apps/transfer_choice.h"
#include "apps/view_choice.h"
#include "files/image_file.h"
#include "graphics/context.h"
#include "projection/opengl/renderer.h"
#include "projection/opengl/surface_renderer.h"
#include "scene/scalar_interval.h"
#include "visorder/error.h"
#include "visorder/sorter_options.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace visorder::apps {

using namespace detail;

namespace {

struct Arguments {
    std::shared_ptr<SceneSource> source;
    std::shared_ptr<ViewChoice> view;
    std::string sorter = "auto";
    SorterOptions sorter_options;
    std::string projector = name(RenderOptions{}.projector);
    std::string integrator = name(RenderOptions{}.integrator);
    std::shared_ptr<TransferChoice> transfer;
    std::string nan = "drop";
    std::vector<double> camera;
    std::optional<double> view_angle;
    std::string size = "512x512";
    int blending_bits = RenderOptions{}.blending_bits;
    std::size_t table_scalars = 0;
    std::size_t table_lengths = TableOptions{}.lengths;
    bool even_lengths = false;
    std::vector<float> background{1, 1, 1};
    std::vector<double> colour;
    std::optional<double> opacity;
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
    camera.view_angle = arguments.view_angle.value_or(camera.view_angle);
    // Near and far plane clip nothing here, but must be somewhere.
    const double distance = glm::length(camera.focal_point - camera.position);
    camera.near = 1e-3 * distance;
    camera.far = 1e3 * distance;
    return view_of(camera, size);
}

bool is_blank(const Image& image)
{
    return std::none_of(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& pixel) { return pixel.w != 0; });
}

// What a picture with nothing in it is for want of.
std::string blank_because(const Scene& scene, const TransferFunction& function)
{
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

struct Picture {
    Image image;
    std::string drawn;              // what, in how long, by what
    std::string blank;              // why, if there is nothing in it
    std::vector<std::string> notes; // lines
};

// What the picture is made of.
struct Subject {
    const Scene& scene;
    const ScalarMap& scalar_map;
    const View& view;
    const std::function<const Order&()>& sorted; // sorts, so that what cannot be drawn is refused before
    const Context& context;
};

RenderOptions render_options(const Arguments& arguments)
{
    RenderOptions options;
    options.projector = projector_named(arguments.projector);
    options.integrator = integrator_named(arguments.integrator);
    options.blending_bits = arguments.blending_bits;
    options.tables = {arguments.table_scalars, arguments.table_lengths, !arguments.even_lengths};
    return options;
}

Picture volume_picture(const Arguments& arguments, const Subject& of)
{
    if (!arguments.colour.empty() || arguments.opacity)
        throw InputError("--color and --opacity are of surfaces; what volumes look like, --transfer says");
    Picture picture;
    const RenderOptions options = render_options(arguments);
    const TransferFunction function = transfer_function_of(*arguments.transfer, of.scene, of.scalar_map, picture.notes);
    ProjectionRenderer renderer(of.context, of.scene, function, options);
    picture.image = renderer.draw(of.view, of.sorted());
    const RenderStatistics& taken = renderer.statistics();
    picture.drawn = fmt::format("{} cells as {} triangles in {:.3f} s by {} and {} on {}", of.scene.cell_count(),
                                taken.triangles, taken.place_s + taken.draw_s + taken.read_s, name(options.projector),
                                name(options.integrator), of.context.renderer());
    if (is_blank(picture.image))
        picture.blank = blank_because(of.scene, function);
    return picture;
}

Picture surface_picture(const Arguments& arguments, const Subject& of)
{
    Picture picture;
    SurfaceOptions options;
    options.blending_bits = arguments.blending_bits;
    options.opacity = arguments.opacity.value_or(options.opacity);
    if (!arguments.colour.empty())
        options.colour = {arguments.colour[0], arguments.colour[1], arguments.colour[2]};
    else if (!of.scene.mesh().scalars.empty())
        options.function = transfer_function_of(*arguments.transfer, of.scene, of.scalar_map, picture.notes);
    SurfaceRenderer renderer(of.context, of.scene, options);
    picture.image = renderer.draw(of.view, of.sorted());
    const SurfaceStatistics& taken = renderer.statistics();
    picture.drawn = fmt::format("{} of {} triangles in {:.3f} s, opacity {:g}, {} on {}", taken.triangles,
                                of.scene.cell_count(), taken.place_s + taken.draw_s + taken.read_s, options.opacity,
                                options.function ? "coloured by scalars" : "in one colour", of.context.renderer());
    if (is_blank(picture.image))
        picture.blank =
            options.opacity == 0 ? "the opacity is 0" : "the view shows nothing of the scene, or its edges alone";
    return picture;
}

std::string cycles_note(const Order& order)
{
    std::size_t cells = 0;
    for (const auto& cycle : order.cycles)
        cells += cycle.size();
    return fmt::format(
        "{} cells occlude each other in {} cycle{}: no order of them is right, and they are drawn in any", cells,
        order.cycles.size(), order.cycles.size() == 1 ? "" : "s");
}

// Of a volume, all cells need a scalar; surfaces that have none get one colour.
std::size_t settle_scalars(const Arguments& arguments, SourcedMesh& sourced, bool is_surface)
{
    if (is_surface && !arguments.colour.empty())
        sourced.mesh.scalars.clear();
    if (sourced.mesh.scalars.empty() && !is_surface)
        sourced.mesh.scalars.assign(sourced.mesh.points.size(), 0.0f);
    return settle_missing_scalars(sourced, arguments.nan);
}

int run(const Arguments& arguments, SourcedMesh& sourced)
{
    const bool exr = is_exr(arguments.output);
    render_options(arguments); // before the work
    const GlPlatform platform = arguments.sorter_options.layers.gl;

    const bool is_surface = !sourced.mesh.shapes.empty() && sourced.mesh.shapes.front() == CellShape::triangle;
    const bool without_scalars = sourced.mesh.scalars.empty() && !is_surface;
    const std::size_t dropped = settle_scalars(arguments, sourced, is_surface);
    const Scene scene(std::move(sourced.mesh));
    const View view = chosen_view(arguments, scene);
    const Context context(platform);
    std::unique_ptr<Sorter> sorter;
    Order order;
    const std::function<const Order&()> sorted = [&]() -> const Order& {
        sorter = make_sorter(arguments.sorter, scene, arguments.sorter_options);
        sorter->sort(view, order);
        return order;
    };
    const Subject subject{scene, sourced.scalar_map, view, sorted, context};
    Picture picture = is_surface ? surface_picture(arguments, subject) : volume_picture(arguments, subject);
    const PngStyle style{{arguments.background[0], arguments.background[1], arguments.background[2]}, true};
    write_file(arguments.output, exr ? exr_of(picture.image) : png_of(picture.image, style));

    std::FILE* const out = message_stream({arguments.output});
    fmt::print(out, "{}: {} x {}, {}; sorted by {} ({})\n", arguments.output, picture.image.size.x,
               picture.image.size.y, picture.drawn, named_sorter(arguments.sorter, scene),
               describe(sorter->guarantee(), scene));
    if (!picture.blank.empty())
        picture.notes.push_back(
            fmt::format("0 of {} cells are visible: {}", scene.cell_count(), std::move(picture.blank)));
    if (without_scalars)
        picture.notes.emplace_back("the mesh has no scalars: all of it is drawn alike");
    if (dropped > 0)
        picture.notes.push_back(
            fmt::format("{} of {} cells are left out of the picture, for a scalar of theirs is missing (--nan)",
                        dropped, scene.cell_count() + dropped));
    if (!order.cycles.empty())
        picture.notes.push_back(cycles_note(order));
    for (const std::string& note : picture.notes)
        fmt::print(out, "{}: {}\n", arguments.output, note);
    tell_faults(out, sourced, scene);
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
    CLI::App* command = app.add_subcommand(
        "render", "Draw a volume of tetrahedra, or a translucent surface of triangles, in a sorter's order");
    arguments->source = add_scene_source(*command);
    arguments->view = add_view_choice(*command);
    command
        ->add_option("--camera", arguments->camera,
                     "Position, focal point and up vector of a perspective camera, nine numbers with commas between")
        ->delimiter(',')
        ->expected(9)
        ->allow_extra_args(false)
        ->excludes("--eye")
        ->excludes("--direction")
        ->excludes(arguments->view->up_option);
    command
        ->add_option("--view-angle", arguments->view_angle,
                     "Vertical, in degrees, of a perspective view (default: 30, or what fits the scene from --eye)")
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
    arguments->transfer = add_transfer_choice(*command);
    command
        ->add_option("--nan", arguments->nan,
                     "Cells with a scalar that is missing: drop them, take the lowest scalar, or refuse")
        ->capture_default_str()
        ->check(CLI::IsMember({"drop", "lowest", "refuse"}));
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
        ->add_option("--color,--colour", arguments->colour,
                     "Of a surface, R,G,B, linear, in [0, 1] (default: by its scalars where it has any)")
        ->delimiter(',')
        ->expected(3)
        ->allow_extra_args(false)
        ->check(between(0, 1));
    command->add_option("--opacity", arguments->opacity, "Of a surface's triangles (default: 0.5)")
        ->check(between(0, 1));
    command
        ->add_option("-o,--output", arguments->output, "Where to: .png, or .exr for the floats; - for standard output")
        ->required();
    command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

} // namespace visorder::apps
