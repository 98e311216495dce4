// VTK's projected tetrahedra beside visorder's, in one run: the same cells, transfer function, cameras and software
// OpenGL, sorting included. Prints seconds a frame and the error against the reference ray caster. VTK needs a window:
//
//     xvfb-run -s "-screen 0 1024x1024x24" visorder_vtk_projected_tetrahedra MESH [TRANSFER [INTEGRATOR [SORTER]]]
//
// MESH is a file, of which @ARRAY chooses the scalar, or a generated scene's name with a colon. VTK takes what its
// opacity function holds as extinction per unit distance, so visorder's extinction times that distance is what it is
// given.

#include "bench/frames.h"
#include "bench/image_file.h"
#include "bench/volume.h"
#include "checking/image_errors.h"
#include "checking/ray_caster.h"
#include "graphics/context.h"
#include "projection/renderer.h"
#include "sorting/registry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fmt/format.h>
#include <future>
#include <glm/geometric.hpp>
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
using Clock = std::chrono::steady_clock;

constexpr int image_side = 512;
constexpr int frames = 12;

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

// Of one frame: by the clock, and of all processors together, which other work on the machine disturbs less.
struct Taken {
    double seconds;
    double processor_seconds;
};

class Timer {
public:
    Taken a_frame() const
    {
        return {std::chrono::duration<double>(Clock::now() - start_).count() / frames,
                static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC / frames};
    }

private:
    Clock::time_point start_ = Clock::now();
    std::clock_t processor_start_ = std::clock();
};

struct Frames {
    Image first;
    Taken taken; // by one of the others
    std::string gl_renderer;
};

Frames our_frames(const Scene& scene, const TransferFunction& function, const RenderOptions& options,
                  const std::string& sorter_name, const std::vector<Camera>& cameras)
{
    const Context context;
    ProjectionRenderer renderer(context, scene, function, options);
    const auto sorter = make_sorter(sorter_name, scene);
    Order order;
    const auto frame = [&](const Camera& from) {
        const View view = view_of(from, {image_side, image_side});
        sorter->sort(view, order);
        return renderer.draw(view, order);
    };
    Image first = frame(cameras.front());
    const Timer timer;
    for (int i = 1; i <= frames; ++i)
        frame(cameras[static_cast<std::size_t>(i)]);
    return {std::move(first), timer.a_frame(), context.renderer()};
}

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

    const vtkNew<vtkProjectedTetrahedraMapper> mapper;
    mapper->SetInputData(grid_of(scene.mesh()));
    const vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    set_function(*volume->GetProperty(), function, 1 / most);
    const vtkNew<vtkRenderer> vtk_renderer;
    vtk_renderer->AddVolume(volume);
    vtk_renderer->SetBackground(0, 0, 0);
    const vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(image_side, image_side);
    window->AddRenderer(vtk_renderer);
    vtk_renderer->ResetCamera();
    vtkCamera& camera = *vtk_renderer->GetActiveCamera();
    camera.Azimuth(30);
    camera.Elevation(20);
    vtk_renderer->ResetCameraClippingRange();
    window->Render();
    const Image from_vtk = vtk_image(*window);
    std::vector<Camera> cameras{camera_of(camera)};
    const Timer vtk_timer;
    for (int i = 0; i < frames; ++i) {
        camera.Azimuth(7);
        vtk_renderer->ResetCameraClippingRange();
        window->Render();
        cameras.push_back(camera_of(camera));
    }
    const Taken vtk_taken = vtk_timer.a_frame();

    RenderOptions options;
    if (argc > 3)
        options.integrator = integrator_named(argv[3]);
    const std::string sorter_name = argc > 4 ? argv[4] : "auto";
    // VTK's window is current on this thread, and its kind of context does not make way for another.
    const Frames ours = std::async(std::launch::async, [&] {
                            return our_frames(scene, function, options, sorter_name, cameras);
                        }).get();

    const Image truth =
        without_alpha(image_of(cast_rays(scene, medium, view_of(cameras.front(), {image_side, image_side}))));
    write_png(from_vtk, "vtk_projected_tetrahedra.png", {glm::vec3(0), true});
    write_png(without_alpha(ours.first), "visorder_projected_tetrahedra.png", {glm::vec3(0), true});
    const double cells = scene.cell_count();
    fmt::print("{} cells, {} x {} pixels, {}, on {}\n", scene.cell_count(), image_side, image_side, transfer,
               ours.gl_renderer);
    const auto report = [&](const std::string& title, const Taken& taken, const Image& image) {
        fmt::print("{}: {:.3f} s a frame ({:.3f} s of processors), {:.2f} M cells/s, RMSE {:.2e}\n", title,
                   taken.seconds, taken.processor_seconds, 1e-6 * cells / taken.seconds, rmse(image, truth));
    };
    report("vtkProjectedTetrahedraMapper", vtk_taken, from_vtk);
    report(fmt::format("visorder, {} and {}, {}", name(options.projector), name(options.integrator), sorter_name),
           ours.taken, without_alpha(ours.first));
    fmt::print("{:.2f} times the frames, {:.2f} times those of a processor\n", vtk_taken.seconds / ours.taken.seconds,
               vtk_taken.processor_seconds / ours.taken.processor_seconds);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        fmt::print(stderr, "visorder_vtk_projected_tetrahedra MESH [TRANSFER [INTEGRATOR [SORTER]]]\n");
        return 2;
    }
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "visorder_vtk_projected_tetrahedra: {}\n", error.what());
        return 2;
    }
}
