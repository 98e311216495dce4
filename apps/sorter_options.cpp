#include "apps/sorter_options.h"

#include <map>
#include <string>

namespace visorder {

void add_sorter_options(CLI::App& command, SorterOptions& options)
{
    const std::map<std::string, XmpvoRays> rays{{"faces", XmpvoRays::faces}, {"crossings", XmpvoRays::crossings}};
    command
        .add_option(
            "--rays", options.xmpvo_rays,
            "Of xmpvo: faces (every boundary face's centre and corners) or crossings (also those of silhouettes)")
        ->transform(CLI::CheckedTransformer(rays, CLI::ignore_case).description(""))
        ->default_str("crossings")
        ->type_name("TEXT");
    command.add_flag("--windows", options.newell_windows, "Of newell: a list for each of several windows of the image");
    command.add_option("--bsp-seed", options.bsp_seed, "Of bsp-xmpvo: of the samples it takes splitting planes from")
        ->capture_default_str();
}

} // namespace visorder
