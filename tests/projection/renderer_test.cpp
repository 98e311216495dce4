#include "projection/opengl/renderer.h"

#include "bench/constant_medium.h"
#include "bench/frames.h"
#include "checking/image_errors.h"
#include "graphics/context.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/ray_caster.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;

using namespace bench;
using namespace scenes;
namespace {

using testing::HasSubstr;

const Context& context()
{
    static const Context only;
    return only;
}

Scene& scene_of(const char* specification)
{
    static std::map<std::string, std::unique_ptr<Scene>> scenes;
    auto& scene = scenes[specification];
    if (!scene)
        scene = std::make_unique<Scene>(subdivide(generate(specification)).mesh);
    return *scene;
}

TransferFunction function_for(const Scene& scene, const char* name)
{
    return named_transfer_function(name, scene, scene.diameter() / 10);
}

Order order_for(const Scene& scene, const View& view)
{
    Order order;
    make_sorter("auto", scene)->sort(view, order);
    return order;
}

RenderOptions with(Projector projector, Integrator integrator)
{
    RenderOptions options;
    options.projector = projector;
    options.integrator = integrator;
    return options;
}

std::string reproduce(const char* scene, const NamedView& view, const RenderOptions& options)
{
    return std::string(scene) + " seen from " + view.name + " by " + name(options.projector) + " and " +
           name(options.integrator);
}

View inside(const Scene& scene, double view_angle, glm::ivec2 size)
{
    const auto v = scene.mesh().cell(scene.cell_count() / 2);
    glm::dvec3 eye(0);
    for (const PointId p : v)
        eye += 0.25 * scene.mesh().points[p];
    const double radius = scene.diameter() / 2;
    return look_at(eye, eye + glm::dvec3(0.3, 0.2, 1) * radius, radius, view_angle, size);
}

RayCast truth(const Scene& scene, const TransferFunction& function, const View& view)
{
    const std::vector<MediumPoint> medium = medium_of(function);
    RayCastOptions options;
    options.silhouette_margin = 0.25;
    return cast_rays(scene, medium, view, options);
}

class EveryProjector : public testing::TestWithParam<Projector> {};

INSTANTIATE_TEST_SUITE_P(Renderer, EveryProjector, testing::ValuesIn(projectors().begin(), projectors().end()),
                         [](const auto& projector) {
                             std::string title = name(projector.param);
                             std::replace(title.begin(), title.end(), '-', '_');
                             return title;
                         });

// Every pixel, silhouettes included, on every solid scene from twenty views.
TEST_P(EveryProjector, HasNoCracksAndNoDoubleHits)
{
    constexpr double tolerance = 1e-4;
    for (const char* scene_name :
         {"delaunay:500", "carved:700", "grid:400", "fin:600", "post:600", "gear:600", "reactor:600", "tori:600",
          "cavity:2000", "pinwheel", "slivers:400", "offset:500", "contact:500"}) {
        const Scene& scene = scene_of(scene_name);
        const RenderOptions options = with(GetParam(), Integrator::exact);
        ProjectionRenderer renderer(context(), scene, constant_medium(scene), options);
        for (const NamedView& view : twenty_views(scene, glm::ivec2(32))) {
            SCOPED_TRACE(reproduce(scene_name, view, options));
            const Image image = renderer.draw(view.view, order_for(scene, view.view));
            const TransmittanceErrors errors = transmittance_errors(scene, view.view, image, tolerance);
            EXPECT_LE(errors.largest, tolerance) << errors.largest_at.x << ", " << errors.largest_at.y;
        }
    }
}

TEST(Renderer, ExactIntegrationMatchesTheRayCaster)
{
    constexpr glm::ivec2 size(96);
    for (const char* scene_name : {"fin:3000", "carved:3000"})
        for (const Projector projector : projectors())
            for (const char* function_name : {"cool-warm", "narrow-peak", "steps"}) {
                const Scene& scene = scene_of(scene_name);
                const TransferFunction function = function_for(scene, function_name);
                const RenderOptions options = with(projector, Integrator::exact);
                ProjectionRenderer renderer(context(), scene, function, options);
                std::vector<NamedView> views = random_views(scene, 2, 11, size);
                views.push_back({"inside", inside(scene, 100, size)});
                for (const NamedView& view : views) {
                    SCOPED_TRACE(reproduce(scene_name, view, options) + ", " + function_name);
                    const Image image = renderer.draw(view.view, order_for(scene, view.view));
                    const RayCast cast = truth(scene, function, view.view);
                    const ImageErrors errors = image_errors(image, image_of(cast));
                    EXPECT_LT(errors.root_mean_square, 2e-5);
                    EXPECT_LT(errors.largest, 2e-4);
                }
            }
}

TEST(Renderer, IntegratorsComeNearerToTheRayCasterOneByOne)
{
    const Scene& scene = scene_of("carved:3000");
    const double unit = scene.diameter() / 10;
    const double low = extinction_of(0.02, unit);
    // Without a haze, a peak as narrow as the methods bear that look at vertices alone: of one between two vertices,
    // neither sees anything.
    const TransferFunction wide_peak(
        {{0.25, low, {0.2, 0.3, 0.9}}, {0.45, extinction_of(0.9, unit), {1, 0.3, 0.1}}, {0.65, low, {0.9, 0.8, 0.2}}});
    for (const TransferFunction& function : {wide_peak, function_for(scene, "peak-in-haze")})
        for (const Projector projector : {Projector::silhouette, Projector::thick})
            for (const NamedView& view : random_views(scene, 2, 3, glm::ivec2(96))) {
                const RayCast cast = truth(scene, function, view.view);
                double before = std::numeric_limits<double>::infinity();
                for (const Integrator integrator :
                     {Integrator::linear, Integrator::exponential, Integrator::preintegrated_3d, Integrator::exact}) {
                    const RenderOptions options = with(projector, integrator);
                    SCOPED_TRACE(reproduce("carved:3000", view, options));
                    ProjectionRenderer renderer(context(), scene, function, options);
                    const Image image = renderer.draw(view.view, order_for(scene, view.view));
                    const double error = image_errors(image, image_of(cast), cast.near_silhouette).root_mean_square;
                    EXPECT_LT(error, before);
                    before = error;
                }
            }
}

TEST(Renderer, DecomposesCellsInTheShaderAsOnTheProcessor)
{
    constexpr glm::ivec2 size(64);
    for (const char* scene_name : {"carved:700", "slivers:400", "grid:400"})
        for (const Integrator integrator : integrators()) {
            const Scene& scene = scene_of(scene_name);
            const TransferFunction function = function_for(scene, "rainbow");
            ProjectionRenderer on_processor(context(), scene, function, with(Projector::thick, integrator));
            const RenderOptions options = with(Projector::thick_gpu, integrator);
            ProjectionRenderer in_shader(context(), scene, function, options);
            std::vector<NamedView> views = random_views(scene, 2, 13, size);
            views.push_back({"inside", inside(scene, 100, size)});
            for (const NamedView& view : views) {
                SCOPED_TRACE(reproduce(scene_name, view, options));
                const Order order = order_for(scene, view.view);
                const ImageErrors errors =
                    image_errors(in_shader.draw(view.view, order), on_processor.draw(view.view, order));
                EXPECT_LT(errors.root_mean_square, 2e-6);
                EXPECT_LT(errors.largest, 5e-5);
            }
        }
}

TEST(Renderer, DrawsTheSameInTheFormForSoftware)
{
    constexpr glm::ivec2 size(64);
    const Scene& scene = scene_of("slivers:400");
    const TransferFunction function = function_for(scene, "steps");
    for (const Projector projector : projectors())
        for (const Integrator integrator : integrators()) {
            if (projector == Projector::planes && integrator == Integrator::linear)
                continue;
            RenderOptions options = with(projector, integrator);
            options.for_software = true;
            ProjectionRenderer software(context(), scene, function, options);
            options.for_software = false;
            ProjectionRenderer any(context(), scene, function, options);
            std::vector<NamedView> views = random_views(scene, 1, 17, size);
            views.push_back({"inside", inside(scene, 100, size)});
            for (const NamedView& view : views) {
                SCOPED_TRACE(reproduce("slivers:400", view, options));
                const Order order = order_for(scene, view.view);
                EXPECT_LE(image_errors(software.draw(view.view, order), any.draw(view.view, order)).largest, 1e-6);
            }
        }
}

// Interpolated over a triangle as long as the image and far narrower than a pixel, rows are no longer right.
TEST(Renderer, DrawsLongSliversInTheFormForSoftware)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    const auto place = [&] {
        const double x = anywhere(random);
        const double y = anywhere(random);
        return glm::dvec3(x, y, anywhere(random));
    };
    Mesh mesh;
    for (const double width : {3e-4, 1e-4, 3e-5})
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 end = place() * glm::dvec3(1, 1, 0.1);
            const auto first = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.insert(mesh.points.end(), {end, -end, anywhere(random) * end + width * place(),
                                                   anywhere(random) * end + width * place()});
            mesh.scalars.insert(mesh.scalars.end(), {0, 0.3F, 0.7F, 1});
            mesh.add(CellShape::tetrahedron, std::array<std::uint32_t, 4>{first, first + 1, first + 2, first + 3});
        }
    const Scene scene(mesh);
    const TransferFunction opaque({{0, 1e6, glm::dvec3(1, 0.5, 0.25)}});
    RenderOptions options;
    options.for_software = true;
    ProjectionRenderer software(context(), scene, opaque, options);
    options.for_software = false;
    ProjectionRenderer any(context(), scene, opaque, options);
    for (const glm::dvec3& direction : {glm::dvec3(0, 0, 1), glm::dvec3(0.1, 0.2, 1), glm::dvec3(-0.2, 0.1, 1)}) {
        const NamedView view{"its flat side", parallel(direction, glm::dvec3(0), 1, glm::ivec2(512))};
        SCOPED_TRACE(reproduce("slivers across each other", view, options));
        const Order order = order_for(scene, view.view);
        EXPECT_LE(image_errors(software.draw(view.view, order), any.draw(view.view, order)).largest, 1e-6);
    }
}

TEST(Renderer, DrawsWhatIsOpaqueManyTimesOver)
{
    const Scene& scene = scene_of("grid:400");
    const glm::dvec3 colour(0.25, 0.5, 1);
    for (const double extinction : {1e2, 1e4, 1e8}) {
        const TransferFunction function({{0, extinction / scene.diameter(), colour}});
        for (const Projector projector : projectors()) {
            const RenderOptions options = with(projector, Integrator::exact);
            ProjectionRenderer renderer(context(), scene, function, options);
            for (const NamedView& view : random_views(scene, 2, 21, glm::ivec2(48))) {
                SCOPED_TRACE(reproduce("grid:400", view, options) + ", extinction " + std::to_string(extinction));
                const Image image = renderer.draw(view.view, order_for(scene, view.view));
                const RayCast cast = truth(scene, function, view.view);
                EXPECT_LT(image_errors(image, image_of(cast), cast.near_silhouette).largest, 1e-3);
            }
        }
    }
}

TEST(Renderer, EveryIntegratorIsRightWhereAllIsConstant)
{
    const Scene& scene = scene_of("grid:400");
    const TransferFunction function = function_for(scene, "constant");
    for (const Projector projector : projectors())
        for (const Integrator integrator : integrators()) {
            // Neither of these has opacity that depends on length as it should.
            if (integrator == Integrator::linear || integrator == Integrator::preintegrated_2d)
                continue;
            const NamedView view = random_views(scene, 1, 2, glm::ivec2(64)).front();
            const RenderOptions options = with(projector, integrator);
            SCOPED_TRACE(reproduce("grid:400", view, options));
            ProjectionRenderer renderer(context(), scene, function, options);
            const Image image = renderer.draw(view.view, order_for(scene, view.view));
            const RayCast cast = truth(scene, function, view.view);
            EXPECT_LT(image_errors(image, image_of(cast), cast.near_silhouette).root_mean_square, 1e-4);
        }
}

TEST(Renderer, SetsAnotherTransferFunctionWithoutSorting)
{
    const Scene& scene = scene_of("carved:700");
    const NamedView view = random_views(scene, 1, 4, glm::ivec2(48)).front();
    const Order order = order_for(scene, view.view);
    for (const Integrator integrator : integrators()) {
        const RenderOptions options = with(Projector::silhouette, integrator);
        ProjectionRenderer changed(context(), scene, function_for(scene, "rainbow"), options);
        changed.draw(view.view, order);
        changed.set_transfer_function(function_for(scene, "viridis"));
        ProjectionRenderer fresh(context(), scene, function_for(scene, "viridis"), options);
        EXPECT_EQ(image_errors(changed.draw(view.view, order), fresh.draw(view.view, order)).largest, 0)
            << name(integrator);
    }
}

TEST(Renderer, ShowsAWrongOrder)
{
    const Scene& scene = scene_of("carved:3000");
    const NamedView view = random_views(scene, 1, 4, glm::ivec2(64)).front();
    ProjectionRenderer renderer(context(), scene, function_for(scene, "steps"));
    Order order = order_for(scene, view.view);
    const Image right = renderer.draw(view.view, order);
    EXPECT_EQ(image_errors(renderer.draw(view.view, order), right).largest, 0);
    std::reverse(order.back_to_front.begin(), order.back_to_front.end());
    EXPECT_GT(image_errors(renderer.draw(view.view, order), right).root_mean_square, 1e-3);
}

TEST(Renderer, LeaksNothingAndDrawsInAnySize)
{
    const Scene& scene = scene_of("carved:700");
    const std::size_t before = context().live_objects();
    {
        ProjectionRenderer renderer(context(), scene, function_for(scene, "cool-warm"));
        const NamedView view = random_views(scene, 1, 4, glm::ivec2(33, 20)).front();
        const Order order = order_for(scene, view.view);
        renderer.draw(view.view, order);
        const std::size_t one_frame = context().live_objects();
        for (int i = 1; i < 50; ++i) {
            View other = view.view;
            other.size = {1 + i, 50 - i};
            const Image image = renderer.draw(other, order);
            EXPECT_EQ(image.size, other.size);
            renderer.set_transfer_function(function_for(scene, "rainbow"));
        }
        EXPECT_EQ(context().live_objects(), one_frame);
    }
    EXPECT_EQ(context().live_objects(), before);
}

TEST(Renderer, BothPlatformsDrawTheSame)
{
    const Context osmesa(GlPlatform::osmesa);
    if (context().renderer() != osmesa.renderer())
        GTEST_SKIP() << "one of them is " << context().renderer() << ", the other " << osmesa.renderer();
    const Scene& scene = scene_of("carved:3000");
    const NamedView view = random_views(scene, 1, 9, glm::ivec2(64)).front();
    const Order order = order_for(scene, view.view);
    for (const Projector projector : projectors()) {
        const RenderOptions options = with(projector, Integrator::exact);
        ProjectionRenderer a(context(), scene, function_for(scene, "cool-warm"), options);
        ProjectionRenderer b(osmesa, scene, function_for(scene, "cool-warm"), options);
        EXPECT_LT(image_errors(a.draw(view.view, order), b.draw(view.view, order)).largest, 1e-6);
    }
}

TEST(Renderer, BlendsInFewerBitsOnRequest)
{
    const Scene& scene = scene_of("carved:700");
    const NamedView view = random_views(scene, 1, 9, glm::ivec2(48)).front();
    const Order order = order_for(scene, view.view);
    const TransferFunction function = function_for(scene, "cool-warm");
    const Image best = ProjectionRenderer(context(), scene, function).draw(view.view, order);
    double before = 0;
    for (const int bits : {16, 8}) {
        RenderOptions options;
        options.blending_bits = bits;
        const double error =
            image_errors(ProjectionRenderer(context(), scene, function, options).draw(view.view, order), best)
                .root_mean_square;
        EXPECT_GT(error, before);
        before = error;
    }
    EXPECT_LT(before, 0.05);
}

TEST(Renderer, FlatAndTurnedCellsChangeNothing)
{
    Mesh mesh = subdivide(generate("grid:400")).mesh;
    const TransferFunction function({{0, 0.3, glm::dvec3(1, 0.5, 0.25)}, {1, 2, glm::dvec3(0.1, 0.5, 1)}});
    const Scene straight(mesh);
    const NamedView view = random_views(straight, 1, 9, glm::ivec2(48)).front();
    const Image wanted =
        ProjectionRenderer(context(), straight, function).draw(view.view, order_for(straight, view.view));
    for (CellId cell = 0; cell < mesh.cell_count(); cell += 3)
        std::swap(mesh.vertices[mesh.offsets[cell]], mesh.vertices[mesh.offsets[cell] + 1]);
    const Scene turned(mesh);
    EXPECT_LT(image_errors(
                  ProjectionRenderer(context(), turned, function).draw(view.view, order_for(turned, view.view)), wanted)
                  .largest,
              1e-5);
    mesh.add(CellShape::tetrahedron, std::array<std::uint32_t, 4>{0, 0, 1, 2});
    const Scene flat(mesh);
    EXPECT_LT(
        image_errors(ProjectionRenderer(context(), flat, function).draw(view.view, order_for(flat, view.view)), wanted)
            .largest,
        1e-5);
}

void expect_refused(const std::function<void()>& what, const char* words)
{
    try {
        what();
        ADD_FAILURE() << "was taken, not refused with: " << words;
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(words));
    }
}

TEST(Renderer, RefusesWhatItCannotDraw)
{
    const TransferFunction function({{0, 1, glm::dvec3(1)}});
    const auto make = [&](const Mesh& mesh) {
        const Scene scene(mesh);
        const ProjectionRenderer renderer(context(), scene, function);
    };
    expect_refused([&] { make(generate("grid:400")); }, "subdivide");
    Mesh mesh = subdivide(generate("grid:400")).mesh;
    mesh.scalars[7] = std::numeric_limits<float>::quiet_NaN();
    expect_refused([&] { make(mesh); }, "point 7");
    mesh.scalars.clear();
    expect_refused([&] { make(mesh); }, "no scalars");

    const Scene& scene = scene_of("grid:400");
    RenderOptions options;
    options.blending_bits = 12;
    expect_refused([&] { const ProjectionRenderer r(context(), scene, function, options); }, "12 bits");
    expect_refused(
        [&] { const ProjectionRenderer r(context(), scene, function, with(Projector::planes, Integrator::linear)); },
        "thickest");
    options = with(Projector::silhouette, Integrator::preintegrated_3d);
    options.tables.scalars = 1;
    expect_refused([&] { const ProjectionRenderer r(context(), scene, function, options); }, "table of 1");
    expect_refused([] { integrator_named("guess"); }, "guess");
    expect_refused([] { projector_named("guess"); }, "guess");

    ProjectionRenderer renderer(context(), scene, function);
    View view = random_views(scene, 1, 1, glm::ivec2(16)).front().view;
    Order order = order_for(scene, view);
    for (const glm::ivec2 size : {glm::ivec2(0, 16), glm::ivec2(16, -1), glm::ivec2(1 << 20, 16)}) {
        view.size = size;
        expect_refused([&] { renderer.draw(view, order); }, std::to_string(size.x).c_str());
    }
    view.size = {16, 16};
    order.back_to_front[3] = scene.cell_count();
    expect_refused([&] { renderer.draw(view, order); }, "the order lists cell");
    order.back_to_front.pop_back();
    expect_refused([&] { renderer.draw(view, order); }, "the order lists");
}

} // namespace
} // namespace visorder::tests
