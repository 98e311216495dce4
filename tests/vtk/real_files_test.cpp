// The meshes of the data folder, whose counts its README gives.

#include "visorder/read_mesh.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <set>

using namespace visorder;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

std::filesystem::path data(const std::string& name)
{
    return std::filesystem::path(VISORDER_DATA_DIR) / name;
}

#define SKIP_WITHOUT(path)                                                                                             \
    if (!std::filesystem::exists(path))                                                                                \
    GTEST_SKIP() << "needs " << (path)

std::ptrdiff_t count(const Mesh& mesh, CellShape shape)
{
    return std::count(mesh.shapes.begin(), mesh.shapes.end(), shape);
}

/// How many cells have that many points that differ.
std::size_t cells_with(const Mesh& mesh, std::size_t points)
{
    std::size_t cells = 0;
    for (CellId i = 0; i < mesh.cell_count(); ++i) {
        const auto cell = mesh.cell(i);
        cells += std::set<PointId>(cell.begin(), cell.end()).size() == points ? 1 : 0;
    }
    return cells;
}

} // namespace

TEST(RealFiles, BluntFin)
{
    const auto path = data("volumes/bluntfinxyz.bin");
    SKIP_WITHOUT(path);
    const MeshFile file = read_mesh(path);
    EXPECT_EQ(file.mesh.points.size(), 40u * 32 * 32);
    EXPECT_EQ(file.mesh.cell_count(), 37479u);
    EXPECT_EQ(count(file.mesh, CellShape::hexahedron), 37479);
    EXPECT_EQ(file.scalar, "Density");
    EXPECT_EQ(*std::max_element(file.mesh.scalars.begin(), file.mesh.scalars.end()), 4.9775f);
    EXPECT_THAT(file.notes, IsEmpty());
}

TEST(RealFiles, BluntFinHasARowOfHexahedraCollapsedToWedges)
{
    const auto path = data("volumes/bluntfinxyz.bin");
    SKIP_WITHOUT(path);
    const MeshFile file = read_mesh(path, {.weld = true});
    EXPECT_EQ(file.mesh.points.size(), 40u * 32 * 32 - 39);
    EXPECT_THAT(file.notes, ElementsAre("39 points joined with others of the same coordinates"));
    EXPECT_EQ(cells_with(file.mesh, 6), 38u);
    EXPECT_EQ(cells_with(file.mesh, 7), 1u);
}

TEST(RealFiles, PostMeetsItself)
{
    const auto path = data("volumes/postxyz.bin");
    SKIP_WITHOUT(path);
    const MeshFile file = read_mesh(path);
    EXPECT_EQ(file.mesh.points.size(), 38u * 76 * 38);
    EXPECT_EQ(count(file.mesh, CellShape::hexahedron), 102675);
    EXPECT_EQ(file.scalar, "StagnationEnergy"); // the density is 1 everywhere
    EXPECT_THAT(file.notes, IsEmpty());

    const MeshFile welded = read_mesh(path, {.weld = true});
    EXPECT_THAT(welded.notes, ElementsAre("1444 points joined with others of the same coordinates")); // 38 x 38
    EXPECT_EQ(cells_with(welded.mesh, 8), 102675u);
}

TEST(RealFiles, Disk)
{
    const auto path = data("volumes/disk_out_ref.ex2");
    SKIP_WITHOUT(path);
    const MeshFile file = read_mesh(path);
    EXPECT_EQ(file.mesh.points.size(), 8499u);
    EXPECT_EQ(count(file.mesh, CellShape::hexahedron), 7472);
    EXPECT_EQ(file.mesh.cell_count(), 7472u);
    EXPECT_EQ(file.scalar, "Temp");
    EXPECT_EQ(*std::max_element(file.mesh.scalars.begin(), file.mesh.scalars.end()), 913.15f);
    EXPECT_EQ(read_mesh(path, {.scalar = "V"}).scalar, "V");
}

TEST(RealFiles, Can)
{
    const auto path = data("volumes/can.vtu");
    SKIP_WITHOUT(path);
    const MeshFile file = read_mesh(path, {.weld = true});
    EXPECT_EQ(file.mesh.points.size(), 6724u); // can and plate touch without coinciding points
    EXPECT_EQ(file.mesh.cell_count(), 4800u);
    EXPECT_EQ(file.scalar, "EQPS");
    EXPECT_THAT(file.notes, ElementsAre("scalar \"EQPS\" averaged from cells to points"));
}

TEST(RealFiles, AngularSector)
{
    const auto path = data("volumes/AngularSector.vtk");
    SKIP_WITHOUT(path);
    const MeshFile file = read_mesh(path);
    EXPECT_EQ(file.mesh.cell_count(), 7776u);
    EXPECT_EQ(count(file.mesh, CellShape::hexahedron), 7632);
    EXPECT_EQ(count(file.mesh, CellShape::pyramid), 144);
    EXPECT_EQ(file.scalar, ""); // PointId is of VTK's type of ids
    EXPECT_EQ(read_mesh(path, {.scalar = "PointId"}).mesh.scalars.size(), 10141u);
    EXPECT_EQ(read_mesh(path, {.weld = true}).mesh.points.size(), 10141u - 1014);
}

TEST(RealFiles, BunnyOfTetrahedra)
{
    const auto path = data("volumes/bunny.vtu");
    SKIP_WITHOUT(path);
    const MeshFile file = read_mesh(path);
    EXPECT_EQ(file.mesh.points.size(), 5433u);
    EXPECT_EQ(count(file.mesh, CellShape::tetrahedron), 34055);
    EXPECT_EQ(file.mesh.cell_count(), 34055u);
    EXPECT_EQ(file.scalar, "height");
}

TEST(RealFiles, Surfaces)
{
    struct Model {
        const char* name;
        std::size_t points;
        std::size_t triangles;
    };
    for (const auto& [name, points, triangles] : {Model{"woody", 694, 1267}, Model{"suzanne", 507, 968},
                                                  Model{"cow", 2903, 5804}, Model{"teapot", 3644, 6320}}) {
        const auto path = data(std::string("surfaces/") + name + ".obj");
        SKIP_WITHOUT(path);
        const MeshFile file = read_mesh(path);
        EXPECT_EQ(file.mesh.points.size(), points) << name;
        EXPECT_EQ(count(file.mesh, CellShape::triangle), static_cast<std::ptrdiff_t>(triangles)) << name;
        EXPECT_EQ(file.mesh.cell_count(), triangles) << name;
    }
}

TEST(RealFiles, FormatsReadByVtk)
{
    struct Model {
        const char* name;
        std::size_t cells; // of the file, in the mesh
        std::size_t blocks;
    };
    for (const auto& [name, cells, blocks] :
         {Model{"volumes/multicomb_0.vts", 440, 0}, Model{"volumes/two-block.g", 16, 2},
          Model{"volumes/PentaHexa.vtk", 210, 0}, Model{"cases/par.pvtu", 48, 1}, Model{"cases/mb.vtm", 48, 1}}) {
        const auto path = data(name);
        SKIP_WITHOUT(path);
        const MeshFile file = read_mesh(path);
        EXPECT_EQ(std::set<std::uint64_t>(file.file_cells.begin(), file.file_cells.end()).size(), cells) << name;
        EXPECT_EQ(file.blocks.size(), blocks) << name;
    }
}
