#include "apps/sorter_options.h"

#include "apps/image_size.h"
#include "apps/number_check.h"
#include "visorder/error.h"
#include "visorder/sorter_options.h"

#include <map>
#include <string>

namespace visorder::apps {

void add_sorter_options(CLI::App& command, SorterOptions& options)
{
    const std::map<std::string, XmpvoRays> rays{{"faces", XmpvoRays::faces}, {"crossings", XmpvoRays::crossings}};
    command
        .add_option(
            "--rays", options.xmpvo.rays,
            "Of xmpvo: faces (every boundary face's centre and corners) or crossings (also those of silhouettes, of "
            "which some four per boundary face are looked at)")
        ->transform(CLI::CheckedTransformer(rays, CLI::ignore_case).description(""))
        ->default_str("crossings")
        ->type_name("TEXT");
    command.add_flag("--windows", options.newell.windows, "Of newell: a list for each of several windows of the image");
    command
        .add_option("--bsp-seed", options.bsp_xmpvo.seed, "Of bsp-xmpvo: of the samples it takes splitting planes from")
        ->capture_default_str()
        ->check(count_from(0));
    const auto set_layer_size = [&options](const std::string& text) {
        try {
            options.layers.image_size = image_size(text, "--layer-size");
        } catch (const InputError& error) {
            throw CLI::ValidationError(error.what());
        }
    };
    command.add_option_function<std::string>("--layer-size", set_layer_size,
                                             "Of layers, layers-blocked, layers-compute and xmpvo-layered: pixels of "
                                             "their image, WxH (default: the view's)");
    command.add_option("--layer-block", options.layers.block, "Of layers-blocked: pixels of a block's side")
        ->capture_default_str()
        ->check(CLI::IsMember({32, 64, 128}));
    command
        .add_option_function<std::string>(
            "--gl", [&options](const std::string& platform) { options.layers.gl = gl_platform(platform); },
            "Where OpenGL comes from")
        ->default_str(name(options.layers.gl))
        ->check(CLI::IsMember({"auto", "egl", "osmesa"}));
}

std::string named_sorter(const std::string& sorter, const Scene& scene)
{
    return sorter == "auto" ? sorter + ": " + choose_sorter(scene).name : sorter;
}

} // namespace visorder::apps
