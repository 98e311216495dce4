// VTK's projected tetrahedra beside visorder's, in one run: the same cells, transfer function, cameras and software
// OpenGL, sorting included: every integrator, and every projector. Prints seconds a frame and the error against the
// reference ray caster. VTK blends in its window's 8 bits a channel, visorder in 32. VTK needs a window:
//
//     xvfb-run -s "-screen 0 1024x1024x24" visorder_vtk_projected_tetrahedra MESH [TRANSFER [SORTER]]
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
#include <limits>
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

// Of one frame: the least by the clock, and the mean of all processors together, which other work on the machine
// disturbs less.
struct Taken {
    double seconds;
    double processor_seconds;
};

template <class Frame>
Taken taken_by(Frame&& frame)
{
    double least = std::numeric_limits<double>::infinity();
    const std::clock_t processor_start = std::clock();
    for (int i = 1; i <= frames; ++i) {
        const Clock::time_point start = Clock::now();
        frame(i);
        least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
    }
    return {least, static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC / frames};
}

struct Frames {
    RenderOptions options;
    Image first;
    Taken taken; // by one of the others
    std::size_t triangles;
};

struct OurFrames {
    std::string gl_renderer;
    std::vector<Frames> all;
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

OurFrames our_frames(const Scene& scene, const TransferFunction& function, const std::string& sorter_name,
                     const std::vector<Camera>& cameras)
{
    const Context context;
    const auto sorter = make_sorter(sorter_name, scene);
    OurFrames result{context.renderer(), {}};
    for (const RenderOptions& options : variants()) {
        ProjectionRenderer renderer(context, scene, function, options);
        Order order;
        const auto frame = [&](const Camera& from) {
            const View view = view_of(from, {image_side, image_side});
            sorter->sort(view, order);
            return renderer.draw(view, order);
        };
        Image first = frame(cameras.front());
        const Taken taken = taken_by([&](int i) { frame(cameras[static_cast<std::size_t>(i)]); });
        result.all.push_back({options, std::move(first), taken, renderer.statistics().triangles});
    }
    return result;
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
    const Taken vtk_taken = taken_by([&](int) {
        camera.Azimuth(7);
        vtk_renderer->ResetCameraClippingRange();
        window->Render();
        cameras.push_back(camera_of(camera));
    });

    const std::string sorter_name = argc > 3 ? argv[3] : "auto";
    // VTK's window is current on this thread, and its kind of context does not make way for another.
    const OurFrames ours =
        std::async(std::launch::async, [&] { return our_frames(scene, function, sorter_name, cameras); }).get();

    const Image truth =
        without_alpha(image_of(cast_rays(scene, medium, view_of(cameras.front(), {image_side, image_side}))));
    write_png(from_vtk, "vtk_projected_tetrahedra.png", {glm::vec3(0), true});
    write_png(without_alpha(ours.all.back().first), "visorder_projected_tetrahedra.png", {glm::vec3(0), true});
    fmt::print("{} cells, {} x {} pixels, {}, sorted by {}, on {}\n", scene.cell_count(), image_side, image_side,
               transfer, sorter_name, ours.gl_renderer);
    fmt::print("{:<34} {:>9} {:>10} {:>7} {:>14} {:>10} {:>9}\n", "", "s a frame", "processors", "times",
               "of a processor", "triangles", "RMSE");
    const auto report = [&](const std::string& title, const Taken& taken, std::size_t triangles, const Image& image) {
        fmt::print("{:<34} {:>9.3f} {:>10.3f} {:>7.2f} {:>14.2f} {:>10} {:>9.2e}\n", title, taken.seconds,
                   taken.processor_seconds, vtk_taken.seconds / taken.seconds,
                   vtk_taken.processor_seconds / taken.processor_seconds, triangles, rmse(image, truth));
    };
    report("vtkProjectedTetrahedraMapper", vtk_taken, 0, from_vtk);
    for (const Frames& one : ours.all)
        report(fmt::format("{}, {}", name(one.options.projector), name(one.options.integrator)), one.taken,
               one.triangles, without_alpha(one.first));
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
