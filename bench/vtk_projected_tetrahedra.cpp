// VTK's projected tetrahedra beside visorder's, in one run: the same cells, transfer function, cameras and software
// OpenGL, sorting included: every integrator, and every projector. Prints seconds a frame and the error against the
// reference ray caster. They take turns, so that what else the machine does disturbs all alike: in each round, each
// draws from every camera, and of each camera the least time over the rounds counts. VTK blends in its window's 8 bits
// a channel, visorder in 32. VTK needs a window:
//
//     xvfb-run -s "-screen 0 1024x1024x24" visorder_vtk_projected_tetrahedra MESH [TRANSFER [SORTER]]
//
// MESH is a file, of which @ARRAY chooses the scalar, or a generated scene's name with a colon. VTK takes what its
// opacity function holds as extinction per unit distance, so visorder's extinction times that distance is what it is
// given.

#include "bench/frames.h"
#include "bench/volume.h"
#include "checking/image_errors.h"
#include "files/image_file.h"
#include "graphics/context.h"
#include "projection/opengl/renderer.h"
#include "visorder/ray_caster.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fmt/format.h>
#include <future>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <oneapi/tbb/task_arena.h>
#include <string>
#include <utility>
#include <vector>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2)

namespace {

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::bench;
using Clock = std::chrono::steady_clock;

constexpr int image_side = 512;
constexpr int cameras_timed = 12;
constexpr int rounds = 5;

vtkNew<vtkUnstructuredGrid> grid_of(const Mesh& mesh)
{
    vtkNew<vtkUnstructuredGrid> grid;
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const vtkNew<vtkFloatArray> scalars;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        points->InsertNextPoint(mesh.points[i].x, mesh.points[i].y, mesh.points[i].z);
        scalars->InsertNextValue(mesh.scalars[i]);
    }
    grid->SetPoints(points);
    grid->GetPointData()->SetScalars(scalars);
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto v = mesh.cell(cell);
        grid->InsertNextCell(VTK_TETRA, 4, std::vector<vtkIdType>(v.begin(), v.end()).data());
    }
    return grid;
}

void set_function(vtkVolumeProperty& property, const TransferFunction& function, double unit_distance)
{
    const vtkNew<vtkColorTransferFunction> colour;
    const vtkNew<vtkPiecewiseFunction> opacity;
    colour->SetColorSpaceToRGB();
    for (const OpticalPoint& point : function.points()) {
        colour->AddRGBPoint(point.scalar, point.colour.x, point.colour.y, point.colour.z);
        opacity->AddPoint(point.scalar, point.extinction * unit_distance);
    }
    property.SetColor(colour);
    property.SetScalarOpacity(opacity);
    property.SetScalarOpacityUnitDistance(unit_distance);
    property.SetInterpolationTypeToLinear();
    property.ShadeOff();
}

Image vtk_image(vtkRenderWindow& window)
{
    Image image{{image_side, image_side}, {}};
    const float* pixels = window.GetRGBAPixelData(0, 0, image_side - 1, image_side - 1, 0);
    for (std::size_t i = 0; i < std::size_t{image_side} * image_side; ++i)
        image.pixels.emplace_back(pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2], 0);
    delete[] pixels;
    return image;
}

Image without_alpha(Image image)
{
    for (glm::vec4& pixel : image.pixels)
        pixel.w = 0;
    return image;
}

// Over three channels, though four are compared.
double rmse(const Image& a, const Image& b)
{
    return std::sqrt(4.0 / 3.0) * image_errors(a, b).root_mean_square;
}

Camera camera_of(vtkCamera& camera)
{
    Camera result;
    camera.GetPosition(&result.position.x);
    camera.GetFocalPoint(&result.focal_point.x);
    camera.GetViewUp(&result.up.x);
    result.view_angle = camera.GetViewAngle();
    return result;
}

// Of frames from several cameras, in several rounds.
class Times {
public:
    template <class Frame>
    void take(Frame&& frame)
    {
        const std::clock_t processor_start = std::clock();
        for (std::size_t camera = 0; camera < least_.size(); ++camera) {
            const Clock::time_point start = Clock::now();
            frame(camera);
            least_[camera] = std::min(least_[camera], std::chrono::duration<double>(Clock::now() - start).count());
        }
        processor_seconds_ =
            std::min(processor_seconds_, static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC);
    }

    /// Of a frame, in the mean over cameras of their least; and of all processors together, in the best round.
    double seconds() const { return std::accumulate(least_.begin(), least_.end(), 0.0) / cameras_timed; }
    double processor_seconds() const { return processor_seconds_ / cameras_timed; }

private:
    std::vector<double> least_ = std::vector<double>(cameras_timed, std::numeric_limits<double>::infinity());
    double processor_seconds_ = std::numeric_limits<double>::infinity();
};

// By the default projector with every integrator, and then by the others with the default integrator.
std::vector<RenderOptions> variants()
{
    std::vector<RenderOptions> result;
    for (const Integrator integrator : integrators()) {
        result.emplace_back();
        result.back().integrator = integrator;
    }
    for (const Projector projector : projectors())
        if (projector != RenderOptions{}.projector) {
            result.emplace_back();
            result.back().projector = projector;
        }
    return result;
}

// VTK's side. Its window is current on the thread that uses it, and its kind of context does not make way for another.
class Peer {
public:
    Peer(const Mesh& mesh, const TransferFunction& function, double unit_distance)
    {
        mapper_->SetInputData(grid_of(mesh));
        volume_->SetMapper(mapper_);
        set_function(*volume_->GetProperty(), function, unit_distance);
        renderer_->AddVolume(volume_);
        renderer_->SetBackground(0, 0, 0);
        window_->SetOffScreenRendering(1);
        window_->SetMultiSamples(0);
        window_->SetSize(image_side, image_side);
        window_->AddRenderer(renderer_);
        renderer_->ResetCamera();
        vtkCamera& camera = *renderer_->GetActiveCamera();
        camera.Azimuth(30);
        camera.Elevation(20);
        renderer_->ResetCameraClippingRange();
        window_->Render();
    }

    /// The present one, and then others around the volume.
    std::vector<Camera> cameras()
    {
        vtkCamera& camera = *renderer_->GetActiveCamera();
        std::vector<Camera> result{camera_of(camera)};
        for (int i = 0; i < cameras_timed; ++i) {
            camera.Azimuth(7);
            result.push_back(camera_of(camera));
        }
        return result;
    }

    void draw(const Camera& from)
    {
        vtkCamera& camera = *renderer_->GetActiveCamera();
        camera.SetPosition(&from.position.x);
        camera.SetFocalPoint(&from.focal_point.x);
        camera.SetViewUp(&from.up.x);
        renderer_->ResetCameraClippingRange();
        window_->Render();
    }

    Image image() { return vtk_image(*window_); }

private:
    vtkNew<vtkProjectedTetrahedraMapper> mapper_;
    vtkNew<vtkVolume> volume_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkRenderWindow> window_;
};

class Ours {
public:
    Ours(const Scene& scene, const TransferFunction& function, const std::string& sorter_name)
        : sorter_(make_sorter(sorter_name, scene))
    {
        for (const RenderOptions& options : variants())
            renderers_.push_back(std::make_unique<ProjectionRenderer>(context_, scene, function, options));
    }

    const std::string& gl_renderer() const { return context_.renderer(); }

    Image draw(std::size_t variant, const Camera& from)
    {
        const View view = view_of(from, {image_side, image_side});
        sorter_->sort(view, order_);
        return renderers_[variant]->draw(view, order_);
    }
    std::size_t triangles(std::size_t variant) const { return renderers_[variant]->statistics().triangles; }

private:
    Context context_;
    std::unique_ptr<Sorter> sorter_;
    Order order_;
    std::vector<std::unique_ptr<ProjectionRenderer>> renderers_;
};

int run(int argc, char** argv)
{
    const std::string mesh_name = argv[1];
    const std::string transfer = argc > 2 ? argv[2] : "cool-warm";
    const Scene scene(volume_named(mesh_name));
    const TransferFunction function = named_transfer_function(transfer, scene, scene.diameter() / 10);
    double most = 0;
    for (const OpticalPoint& point : function.points())
        most = std::max(most, point.extinction);
    const std::vector<MediumPoint> medium = medium_of(function);

    Peer peer(scene.mesh(), function, 1 / most);
    const std::vector<Camera> cameras = peer.cameras();
    const auto from = [&](std::size_t timed) -> const Camera& { return cameras[timed + 1]; };
    peer.draw(cameras.front());
    const Image from_vtk = peer.image();

    const std::string sorter_name = argc > 3 ? argv[3] : "auto";
    const std::vector<RenderOptions> options = variants();
    std::vector<Image> first;
    std::vector<std::size_t> triangles;
    Times vtk_times;
    std::vector<Times> times(options.size());
    std::string gl_renderer;
    // On threads of its own, so that its context and VTK's are not in each other's way.
    std::unique_ptr<Ours> ours;
    oneapi::tbb::task_arena arena;
    const auto ours_do = [&](auto&& work) { std::async(std::launch::async, [&] { arena.execute(work); }).get(); };
    ours_do([&] {
        ours = std::make_unique<Ours>(scene, function, sorter_name);
        gl_renderer = ours->gl_renderer();
        for (std::size_t i = 0; i < options.size(); ++i)
            first.push_back(without_alpha(ours->draw(i, cameras.front())));
    });
    for (int round = 0; round < rounds; ++round) {
        vtk_times.take([&](std::size_t camera) { peer.draw(from(camera)); });
        ours_do([&] {
            for (std::size_t i = 0; i < options.size(); ++i)
                times[i].take([&](std::size_t camera) { ours->draw(i, from(camera)); });
        });
    }
    ours_do([&] {
        for (std::size_t i = 0; i < options.size(); ++i)
            triangles.push_back(ours->triangles(i));
        ours.reset();
    });

    const Image truth =
        without_alpha(image_of(cast_rays(scene, medium, view_of(cameras.front(), {image_side, image_side}))));
    write_png(from_vtk, "vtk_projected_tetrahedra.png", {glm::vec3(0), true});
    write_png(first.back(), "visorder_projected_tetrahedra.png", {glm::vec3(0), true});
    fmt::print("{} cells, {} x {} pixels, {}, sorted by {}, on {}\n", scene.cell_count(), image_side, image_side,
               transfer, sorter_name, gl_renderer);
    fmt::print("{:<34} {:>9} {:>10} {:>7} {:>14} {:>10} {:>9}\n", "", "s a frame", "processors", "times",
               "of a processor", "triangles", "RMSE");
    const auto report = [&](const std::string& title, const Times& taken, std::size_t drawn, const Image& image) {
        fmt::print("{:<34} {:>9.3f} {:>10.3f} {:>7.2f} {:>14.2f} {:>10} {:>9.2e}\n", title, taken.seconds(),
                   taken.processor_seconds(), vtk_times.seconds() / taken.seconds(),
                   vtk_times.processor_seconds() / taken.processor_seconds(), drawn, rmse(image, truth));
    };
    report("vtkProjectedTetrahedraMapper", vtk_times, 0, from_vtk);
    for (std::size_t i = 0; i < options.size(); ++i)
        report(fmt::format("{}, {}", name(options[i].projector), name(options[i].integrator)), times[i], triangles[i],
               first[i]);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        fmt::print(stderr, "visorder_vtk_projected_tetrahedra MESH [TRANSFER [SORTER]]\n");
        return 2;
    }
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "visorder_vtk_projected_tetrahedra: {}\n", error.what());
        return 2;
    }
}
