// Makes the pictures of the README: visorder_pictures FOLDER.

#include "bench/generated_scene.h"
#include "bench/painting.h"
#include "scene/subdivision.h"
#include "sorting/registry.h"

#include <array>
#include <exception>
#include <fmt/format.h>

namespace {

using namespace visorder;

// One scene in the exact order, by cell centres, and where the two differ.
void exact_against_centroid(const char* specification, const View& view, double opacity, const std::string& file)
{
    const Mesh mesh = subdivide(generate(specification)).mesh;
    const Scene scene(mesh);
    Order exact, by_centres;
    make_sorter("auto", scene)->sort(view, exact);
    make_sorter("centroid", scene)->sort(view, by_centres);
    const Picture right = paint(mesh, exact.back_to_front, view, opacity);
    const Picture wrong = paint(mesh, by_centres.back_to_front, view, opacity);
    write_png(side_by_side(std::array{right, wrong, difference(right, wrong, 4)}, 12), file);
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
        exact_against_centroid("grid:48000", look_at({2.9, 2.1, 3.3}, {0.5, 0.5, 0.5}, 0.9, 25, {400, 400}), 0.25,
                               folder + "/grid.png");
        exact_against_centroid("carved:30000", look_at({2.9, 2.1, 3.3}, {0.5, 0.5, 0.5}, 0.9, 25, {400, 400}), 0.35,
                               folder + "/carved.png");
    } catch (const std::exception& error) {
        fmt::print(stderr, "visorder_pictures: {}\n", error.what());
        return 2;
    }
    return 0;
}
