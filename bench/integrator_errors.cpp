// What every integrator makes of a scene against the reference ray caster, from three kinds of view: parallel, wide
// perspective, and with the eye inside the mesh. Exit status 1 where a bound is missed that the renderer is held to:
// `exact` with an RMSE of 1e-4 and, away from silhouettes, a maximum of 5e-3; `preintegrated-3d` with an RMSE of 2e-3;
// and, on peak-in-haze and the functions peak:WIDTH, errors that fall from linear over exponential and preintegrated-3d
// to exact. Linear and exponential know the vertices alone: of a peak narrower than what the scalar changes by along a
// cell either sees as little as the other, unless a haze around it tells them apart. So that change is printed too.
//
//     visorder_integrator_errors MESH[@ARRAY]... [--function NAME|peak:WIDTH]... [--size N]

#include "bench/frames.h"
#include "bench/volume.h"
#include "checking/image_errors.h"
#include "projection/opengl/renderer.h"
#include "scene/scalar_interval.h"
#include "scene/stopwatch.h"
#include "visorder/error.h"
#include "visorder/ray_caster.h"
#include "visorder/sorters.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::bench;

constexpr std::string_view peak_prefix = "peak:";
constexpr double exact_rmse = 1e-4;
constexpr double exact_largest = 5e-3;
constexpr double preintegrated_rmse = 2e-3;

// A peak of opacity 0.9 in a medium of 0.02 and two other colours, around the median of the points' scalars; from foot
// to foot it is as wide as `width` of their range.
TransferFunction peak(const Scene& scene, double width)
{
    std::vector<float> scalars = scene.mesh().scalars;
    const double reach = width * scalar_interval(scene.mesh()).value().width() / 2;
    const auto middle = scalars.begin() + static_cast<std::ptrdiff_t>(scalars.size() / 2);
    std::nth_element(scalars.begin(), middle, scalars.end());
    const double unit = scene.diameter() / 10;
    const double low = extinction_of(0.02, unit);
    return TransferFunction({{*middle - reach, low, {0.2, 0.3, 0.9}},
                             {*middle, extinction_of(0.9, unit), {1, 0.3, 0.1}},
                             {*middle + reach, low, {0.9, 0.8, 0.2}}});
}

bool is_peak(const std::string& function)
{
    return function.rfind(peak_prefix, 0) == 0;
}

bool tells_all_apart(const std::string& function)
{
    return is_peak(function) || function == "peak-in-haze";
}

TransferFunction function_named(const std::string& name, const Scene& scene)
{
    if (!is_peak(name))
        return named_transfer_function(name, scene, scene.diameter() / 10);
    const double width = std::stod(name.substr(peak_prefix.size()));
    if (!(width > 0 && width <= 1))
        throw InputError(fmt::format("{}: a peak's width lies in (0, 1]", name));
    return peak(scene, width);
}

struct KindOfView {
    const char* name;
    View view;
};

std::array<KindOfView, 3> views_of(const Scene& scene, int side)
{
    const glm::ivec2 size(side);
    const double radius = scene.diameter() / 2;
    const glm::dvec3 middle = scene.bounds().middle();
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.4, -0.5, 0.75));
    // Amid a cell halfway along the order of the cells in memory.
    glm::dvec3 inside(0);
    for (const PointId p : scene.mesh().cell(scene.cell_count() / 2))
        inside += 0.25 * scene.mesh().points[p];
    return {KindOfView{"parallel", parallel(towards, middle, radius, size)},
            KindOfView{"wide", look_at(middle + 1.2 * radius * towards, middle, radius, 100, size)},
            KindOfView{"inside", look_at(inside, inside + glm::dvec3(0.3, 0.2, 1) * radius, radius, 90, size)}};
}

// The median over cells of how far their scalars are apart, as a part of the range of all.
double change_along_cells(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    std::vector<double> changes;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto v = mesh.cell(cell);
        const auto [lowest, highest] =
            std::minmax({mesh.scalars[v[0]], mesh.scalars[v[1]], mesh.scalars[v[2]], mesh.scalars[v[3]]});
        changes.push_back(static_cast<double>(highest) - static_cast<double>(lowest));
    }
    const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
    std::nth_element(changes.begin(), middle, changes.end());
    return *middle / scalar_interval(mesh).value().width();
}

class Study {
public:
    explicit Study(int side) : side_(side) {}

    void run(const std::string& mesh_name, const std::vector<std::string>& functions)
    {
        const Scene scene(volume_named(mesh_name));
        fmt::print("{}: {} cells, along which scalars change by {:.3f} of their range in the median\n",
                   std::filesystem::path(mesh_name).filename().string(), scene.cell_count(), change_along_cells(scene));
        const auto sorter = make_sorter("auto", scene);
        for (const KindOfView& kind : views_of(scene, side_)) {
            Order order;
            sorter->sort(kind.view, order);
            for (const std::string& function_name : functions) {
                const TransferFunction function = function_named(function_name, scene);
                RayCastOptions options;
                options.silhouette_margin = 1;
                Stopwatch watch;
                const RayCast cast = cast_rays(scene, medium_of(function), kind.view, options);
                const Image truth = image_of(cast);
                fmt::print(" {} view, {}: {:.1f} s of ray casting\n", kind.name, function_name, watch.lap());
                double before = std::numeric_limits<double>::infinity();
                for (const Integrator integrator :
                     {Integrator::linear, Integrator::exponential, Integrator::preintegrated_2d,
                      Integrator::preintegrated_3d, Integrator::exact}) {
                    RenderOptions render;
                    render.integrator = integrator;
                    ProjectionRenderer renderer(context_, scene, function, render);
                    const Image image = renderer.draw(kind.view, order);
                    const ImageErrors all = image_errors(image, truth);
                    const ImageErrors away = image_errors(image, truth, cast.near_silhouette);
                    std::string missed;
                    if (integrator == Integrator::exact) {
                        missed += all.root_mean_square <= exact_rmse ? "" : " rmse";
                        missed += away.largest <= exact_largest ? "" : " max";
                    }
                    if (integrator == Integrator::preintegrated_3d && !(all.root_mean_square <= preintegrated_rmse))
                        missed += " rmse";
                    // Scaled by length, a table for one length is no step between the others.
                    if (tells_all_apart(function_name) && integrator != Integrator::preintegrated_2d) {
                        missed += all.root_mean_square < before ? "" : " order";
                        before = all.root_mean_square;
                    }
                    missed_ += missed.empty() ? 0 : 1;
                    fmt::print("  {:<17}RMSE {:.2e}   max {:.2e}   max away from silhouettes {:.2e}   beyond 1/255 "
                               "{:6.2f} %{}{}\n",
                               name(integrator), all.root_mean_square, all.largest, away.largest,
                               100 * all.beyond_one_level, missed.empty() ? "" : "   missed:", missed);
                }
                std::fflush(stdout);
            }
        }
    }

    int missed() const { return missed_; }

private:
    int side_;
    Context context_;
    int missed_ = 0;
};

} // namespace

int main(int argc, char** argv)
{
    std::vector<std::string> meshes;
    std::vector<std::string> functions{"cool-warm", "narrow-peak", "peak-in-haze", "peak:0.2", "peak:0.4"};
    int side = 512;
    CLI::App app("The errors of all integrators against the reference ray caster");
    app.add_option("mesh", meshes, "Files, of which @ARRAY chooses the scalar, or generated scenes NAME:SIZE")
        ->required();
    app.add_option("--function", functions, "Named transfer functions, or peak:WIDTH, in the scalar's range");
    app.add_option("--size", side, "Pixels along each side of the image")->check(CLI::Range(1, 4096));
    CLI11_PARSE(app, argc, argv);
    try {
        Study study(side);
        for (const std::string& mesh : meshes)
            study.run(mesh, functions);
        fmt::print("{} bounds missed\n", study.missed());
        return study.missed() == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "visorder_integrator_errors: {}\n", error.what());
        return 2;
    }
}
