#include <cstdio>
#include <visorder/visorder.h>

int main()
{
    visorder::Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {-1, 0, 0}};
    mesh.add(visorder::CellShape::tetrahedron, std::array{0u, 1u, 2u, 3u});
    mesh.add(visorder::CellShape::tetrahedron, std::array{1u, 2u, 3u, 4u});
    mesh.add(visorder::CellShape::tetrahedron, std::array{0u, 3u, 2u, 5u});

    const visorder::View view = visorder::look_at({3, 3, 3}, {0, 0, 0}, 2); // position, target, radius
    const visorder::Order order = visorder::visibility_order(mesh, view);
    for (const visorder::CellId cell : order.back_to_front)
        std::printf("cell %u\n", cell);
}
