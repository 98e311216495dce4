#include "bench/constant_medium.h"
#include "scenes/generated_scene.h"
#include "visorder/mesh.h"
#include "visorder/sorters.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fmt/format.h>

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::bench;
using namespace visorder::scenes;

// Transmittance of a constant medium against the lengths of rays: no cracks, no double hits. Exit status 1 where a
// pixel is off by more than 1e-4.
int main(int argc, char** argv)
{
    std::vector<std::string> scenes{"delaunay:3000", "carved:3000",  "grid:3000",   "fin:3000",    "post:3000",
                                    "gear:3000",     "reactor:3000", "tori:3000",   "cavity:3000", "pinwheel",
                                    "slivers:3000",  "offset:3000",  "contact:3000"};
    std::vector<std::string> wanted_projectors;
    int side = 128;
    bool every_view = false;
    CLI::App app("How far the transmittance of a constant medium is from what chord lengths say, over twenty views");
    app.add_option("--scene", scenes, "NAME[:SIZE[:SEED]] of generated scenes");
    app.add_option("--projector", wanted_projectors, "all, unless given");
    app.add_option("--size", side, "pixels along each side of the image")->check(CLI::Range(1, 4096));
    app.add_flag("--each", every_view, "a line for every view");
    CLI11_PARSE(app, argc, argv);
    try {
        std::vector<Projector> which(projectors().begin(), projectors().end());
        if (!wanted_projectors.empty())
            which.clear();
        for (const std::string& name : wanted_projectors)
            which.push_back(projector_named(name));
        constexpr double tolerance = 1e-4;
        const Context context;
        bool all = true;
        fmt::print("{:<16}{:<12}{:>10}{:>10}{:>10}{:>11}  {}\n", "scene", "projector", "pixels", "beyond", "largest",
                   "near cells", "seen");
        for (const std::string& specification : scenes) {
            const Scene scene(subdivide(generate(specification)).mesh);
            const std::vector<NamedView> views = twenty_views(scene, glm::ivec2(side));
            const auto sorter = make_sorter("auto", scene);
            for (const Projector projector : which) {
                RenderOptions options;
                options.projector = projector;
                ProjectionRenderer renderer(context, scene, constant_medium(scene), options);
                TransmittanceErrors worst;
                std::string worst_view;
                std::size_t near_cells = 0;
                const auto print = [&](const TransmittanceErrors& errors, const std::string& from) {
                    fmt::print("{:<16}{:<12}{:>10}{:>10}{:>10.1e}{:>11}  {} at {}, {}\n", specification,
                               name(projector), errors.pixels, errors.beyond, errors.largest, near_cells, from,
                               errors.largest_at.x, errors.largest_at.y);
                };
                for (const NamedView& view : views) {
                    Order order;
                    sorter->sort(view.view, order);
                    const Image image = renderer.draw(view.view, order);
                    near_cells += renderer.statistics().near_cells;
                    const TransmittanceErrors errors = transmittance_errors(scene, view.view, image, tolerance);
                    if (every_view)
                        print(errors, view.name);
                    worst.beyond += errors.beyond;
                    worst.pixels += errors.pixels;
                    if (worst_view.empty() || !(errors.largest <= worst.largest)) {
                        worst.largest = errors.largest;
                        worst.largest_at = errors.largest_at;
                        worst_view = view.name;
                    }
                }
                print(worst, worst_view);
                std::fflush(stdout);
                all = all && worst.beyond == 0;
            }
        }
        return all ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
