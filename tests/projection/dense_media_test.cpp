#include "bench/frames.h"
#include "checking/image_errors.h"
#include "graphics/context.h"
#include "projection/opengl/renderer.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/mesh.h"
#include "visorder/ray_caster.h"
#include "visorder/sorters.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;

using namespace bench;
using namespace scenes;
namespace {

struct NamedScene {
    std::string name;
    std::unique_ptr<Scene> scene;
};

// One cell, along which the scalar runs through all of a transfer function.
std::unique_ptr<Scene> one_cell()
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.scalars = {0, 1, 0.3F, 0.6F};
    mesh.add(CellShape::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
    return std::make_unique<Scene>(mesh);
}

// Of extinctions that are 1 at most.
std::vector<std::pair<std::string, std::vector<OpticalPoint>>> functions()
{
    const glm::dvec3 red(1, 0.2, 0.1);
    const glm::dvec3 green(0.1, 0.9, 0.3);
    const glm::dvec3 blue(0.2, 0.3, 1);
    return {
        {"constant", {{0.5, 1, red}}},
        {"ramp", {{0, 0, red}, {1, 1, blue}}},
        {"narrow peak", {{0, 0, green}, {0.445, 0, blue}, {0.45, 1, red}, {0.455, 0, green}, {1, 0, green}}},
        {"very narrow peak in haze",
         {{0, 1e-4, green}, {0.35, 1e-4, blue}, {0.35001, 1, red}, {0.35002, 1e-4, green}, {1, 2e-4, red}}},
        {"jump", {{0, 0.01, green}, {0.55, 0.02, blue}, {0.55, 1, red}, {0.7, 0.3, green}, {0.7, 0, green}}},
    };
}

TransferFunction scaled(std::vector<OpticalPoint> points, double extinction)
{
    for (OpticalPoint& p : points)
        p.extinction *= extinction;
    return TransferFunction(std::move(points));
}

std::vector<NamedView> views_of(const Scene& scene)
{
    constexpr glm::ivec2 size(32);
    const glm::dvec3 middle = scene.bounds().middle();
    const double radius = scene.diameter() / 2;
    const auto v = scene.mesh().cell(scene.cell_count() / 2);
    glm::dvec3 inside(0);
    for (const PointId p : v)
        inside += 0.25 * scene.mesh().points[p];
    return {
        {"far", look_at(middle + glm::dvec3(4, 0.4, 0.3) * radius, middle, radius, 30, size)},
        {"infinitely far", parallel({0.3, -0.7, 0.5}, middle, radius, size)},
        {"inside", look_at(inside, inside + glm::dvec3(0.3, 0.2, 1) * radius, radius, 100, size)},
    };
}

// However dense the medium, and however little of it is.
TEST(DenseMedia, ExactIntegrationIsTheRayCasters)
{
    static const Context context;
    std::vector<NamedScene> scenes;
    scenes.push_back({"one cell", one_cell()});
    for (const char* specification : {"delaunay:150", "delaunay:300:2", "carved:300:3"})
        scenes.push_back({specification, std::make_unique<Scene>(subdivide(generate(specification)).mesh)});
    for (const NamedScene& scene : scenes) {
        std::vector<std::unique_ptr<ProjectionRenderer>> renderers;
        for (const Projector projector : projectors()) {
            RenderOptions options;
            options.projector = projector;
            renderers.push_back(std::make_unique<ProjectionRenderer>(
                context, *scene.scene, TransferFunction({{0, 1, glm::dvec3(1)}}), options));
        }
        for (const auto& [function_name, points] : functions())
            for (const double extinction : {1e-3, 1.0, 10.0, 1e2, 1e4, 1e9}) {
                const TransferFunction function = scaled(points, extinction);
                for (const auto& renderer : renderers)
                    renderer->set_transfer_function(function);
                for (const NamedView& view : views_of(*scene.scene)) {
                    RayCastOptions options;
                    options.silhouette_margin = 1;
                    const RayCast cast = cast_rays(*scene.scene, medium_of(function), view.view, options);
                    Order order;
                    make_sorter("auto", *scene.scene)->sort(view.view, order);
                    for (std::size_t i = 0; i < renderers.size(); ++i) {
                        const ImageErrors errors =
                            image_errors(renderers[i]->draw(view.view, order), image_of(cast), cast.near_silhouette);
                        const std::string what =
                            fmt::format("{} seen from {}, {} times {}, by {}", scene.name, view.name, function_name,
                                        extinction, name(projectors()[i]));
                        EXPECT_LT(errors.root_mean_square, 1e-6) << what;
                        EXPECT_LT(errors.largest, 1e-6) << what;
                    }
                }
            }
    }
}

} // namespace
} // namespace visorder::tests
