#include <algorithm>
#include <cstdio>
#include <visorder/visorder.h>

int main()
{
    visorder::Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    mesh.scalars = {0, 1, 2, 3, 4};
    mesh.add(visorder::CellShape::tetrahedron, std::array{0u, 1u, 2u, 3u});
    mesh.add(visorder::CellShape::tetrahedron, std::array{1u, 2u, 3u, 4u});

    const visorder::Scene scene(mesh);
    const auto sorter = visorder::make_sorter("auto", scene);
    const auto function = visorder::named_transfer_function("viridis", scene, scene.diameter() / 10);
    const auto renderer = visorder::make_opengl_renderer(scene, function);

    const visorder::View view = visorder::look_at({3, 3, 3}, {0.5, 0.5, 0.5}, 1);
    visorder::Order order;
    sorter->sort(view, order);
    const visorder::Image image = renderer->draw(view, order); // linear colour, premultiplied by alpha
    const auto seen = std::count_if(image.pixels.begin(), image.pixels.end(), [](const auto& p) { return p.a > 0; });
    std::printf("the volume covers %.0f %% of the picture\n", 100.0 * seen / image.pixels.size());
}
