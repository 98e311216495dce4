// Makes the pictures of the README: visorder_pictures FOLDER.

#include "bench/painting.h"
#include "checking/image_errors.h"
#include "files/image_file.h"
#include "scenes/generated_scene.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/sorters.h"

#include <array>
#include <exception>
#include <fmt/format.h>

namespace {

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::bench;
using namespace visorder::scenes;

// One scene in an order that is right from this view, by cell centres, and where the two differ.
void right_against_centroid(const char* specification, const View& view, double opacity, const std::string& file)
{
    const Mesh mesh = subdivide(generate(specification)).mesh;
    const Scene scene(mesh);
    Order right, by_centres;
    make_sorter("auto", scene)->sort(view, right);
    make_sorter("centroid", scene)->sort(view, by_centres);
    if (const CheckResult result = OrderChecker(scene).check(view.eye, right); result.violations > 0)
        throw InputError(
            fmt::format("{}: {} relations of the right order are violated", specification, result.violations));
    const Image painted = paint(mesh, right.back_to_front, view, opacity);
    const Image wrong = paint(mesh, by_centres.back_to_front, view, opacity);
    write_png(side_by_side(std::array{painted, wrong, difference_image(painted, wrong, 4)}, 12), file,
              {.to_srgb = false});
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        fmt::print(stderr, "usage: visorder_pictures FOLDER\n");
        return 2;
    }
    try {
        const std::string folder = argv[1];
        const View view = look_at({2.9, 2.1, 3.3}, {0.5, 0.5, 0.5}, 0.9, 25, {400, 400});
        right_against_centroid("delaunay:30000", view, 0.35, folder + "/delaunay.png");
        right_against_centroid("carved:30000", view, 0.35, folder + "/carved.png");
    } catch (const std::exception& error) {
        fmt::print(stderr, "visorder_pictures: {}\n", error.what());
        return 2;
    }
    return 0;
}
