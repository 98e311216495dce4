// What is taken of a file: points, cells, scalars; and what of a file is refused. By .vtu files, which hold everything.

#include "tests/reading_error.h"
#include "tests/temporary_folder.h"
#include "vtu_text.h"

#include <atomic>
#include <cmath>
#include <gmock/gmock.h>
#include <thread>
#include <vtkOutputWindow.h>

using namespace visorder;
using namespace visorder::tests;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

const TemporaryFolder folder;

MeshFile read(const VtuText& vtu, const ReadOptions& options = {})
{
    return read_mesh(folder.write("mesh.vtu", vtu.str()), options);
}

std::string error_of(const VtuText& vtu, const ReadOptions& options = {})
{
    return reading_error(folder.write("mesh.vtu", vtu.str()), options);
}

} // namespace

TEST(Vtu, ReadsPointsAndCellsInTheirOrder)
{
    const MeshFile file = read(vtu_of_two_tetrahedra());
    EXPECT_EQ(file.mesh.points.size(), 5u);
    EXPECT_EQ(file.mesh.points[4], glm::dvec3(-1, 0, 0));
    EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::tetrahedron, CellShape::tetrahedron));
    EXPECT_THAT(file.mesh.cell(1), ElementsAre(0, 2, 1, 4));
    EXPECT_THAT(file.mesh.scalars, IsEmpty());
    EXPECT_EQ(file.scalar, "");
    EXPECT_THAT(file.notes, IsEmpty());
}

TEST(Vtu, KeepsEveryBitOfADoubleCoordinate)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.points[3][0] = 0.1;
    EXPECT_EQ(read(vtu).mesh.points[3].x, 0.1);
}

TEST(Vtu, TakesTheFirstPointScalarOfOneComponentThatHoldsNoIds)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.point_attributes = "GlobalIds=\"id\"";
    vtu.point_arrays = {{"id", 1, {1, 2, 3, 4, 5}, "Int64"},
                        {"velocity", 3, {1, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 4}},
                        {"heat", 1, {5, 4, 3, 2, 1.5}},
                        {"load", 1, {0, 0, 0, 0, 0}}};
    vtu.cell_arrays = {{"heat", 1, {0, 0}}};
    const MeshFile file = read(vtu);
    EXPECT_EQ(file.scalar, "heat");
    EXPECT_THAT(file.mesh.scalars, ElementsAre(5, 4, 3, 2, 1.5f));
    EXPECT_THAT(file.notes, IsEmpty());

    EXPECT_THAT(read(vtu, {.scalar = "load"}).mesh.scalars, ElementsAre(0, 0, 0, 0, 0));
    EXPECT_THAT(read(vtu, {.scalar = "id"}).mesh.scalars, ElementsAre(1, 2, 3, 4, 5));
}

TEST(Vtu, TakesTheMagnitudeOfAVector)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.point_arrays = {{"velocity", 3, {1, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 4}}};
    EXPECT_EQ(read(vtu).scalar, "velocity");
    const MeshFile file = read(vtu, {.scalar = "velocity"});
    EXPECT_THAT(file.mesh.scalars, ElementsAre(3, 0, 0, 0, 5));
    EXPECT_THAT(file.notes, ElementsAre("scalar \"velocity\" is the magnitude of 3 components"));
}

TEST(Vtu, AveragesCellDataOverTheCellsOfEachPoint)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.cell_arrays = {{"stress", 1, {2, 5}}};
    const MeshFile file = read(vtu);
    EXPECT_EQ(file.scalar, "stress");
    EXPECT_THAT(file.mesh.scalars, ElementsAre(3.5f, 3.5f, 3.5f, 2, 5));
    EXPECT_THAT(file.notes, ElementsAre("scalar \"stress\" averaged from cells to points"));
}

TEST(Vtu, AveragesCellDataOverCellsThatAreNotLeftOut)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.cells.insert(vtu.cells.begin() + 1, {5, {0, 1, 2}});
    vtu.cell_arrays = {{"stress", 1, {2, 1000, 5}}};
    const MeshFile file = read(vtu);
    EXPECT_THAT(file.mesh.scalars, ElementsAre(3.5f, 3.5f, 3.5f, 2, 5));
    EXPECT_THAT(file.notes, ElementsAre("1 surface cells beside the solids left out",
                                        "scalar \"stress\" averaged from cells to points"));
}

TEST(Vtu, KeepsScalarsBeyondTheRangeOfSinglePrecision)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    const std::vector<double> values{1e299, 2e299, 3e299, 4e299, 1e300};
    vtu.point_arrays = {{"heat", 1, values}};
    const MeshFile file = read(vtu);
    EXPECT_THAT(file.notes, IsEmpty());
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(file.scalar_map.value(file.mesh.scalars[i]) / values[i], 1, 1e-6) << i;
}

TEST(Vtu, LeavesOutPointsThatNoCellUses)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.points.insert(vtu.points.begin() + 1, {7, 7, NAN});
    vtu.cells = {{10, {0, 2, 3, 4}}, {10, {0, 3, 2, 5}}};
    vtu.point_arrays = {{"heat", 1, {5, 0, 4, 3, 2, 1}}};
    const MeshFile file = read(vtu);
    EXPECT_EQ(file.mesh.points.size(), 5u);
    EXPECT_THAT(file.mesh.cell(1), ElementsAre(0, 2, 1, 4));
    EXPECT_THAT(file.mesh.scalars, ElementsAre(5, 4, 3, 2, 1));
    EXPECT_THAT(file.notes, ElementsAre("1 points that no cell uses left out"));
}

TEST(Vtu, WeldsOnRequestOnly)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.points.push_back({0, 1, 0});
    vtu.cells[1].points = {0, 2, 5, 4};
    EXPECT_EQ(read(vtu).mesh.points.size(), 6u);
    const MeshFile file = read(vtu, {.weld = true});
    EXPECT_EQ(file.mesh.points.size(), 5u);
    EXPECT_THAT(file.mesh.cell(1), ElementsAre(0, 2, 1, 4));
    EXPECT_THAT(file.notes, ElementsAre("1 points joined with others of the same coordinates"));
}

TEST(Vtu, LeavesOutHiddenCells)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.cell_arrays = {{"vtkGhostType", 1, {0, 32}, "UInt8"}};
    const MeshFile file = read(vtu);
    EXPECT_EQ(file.mesh.cell_count(), 1u);
    EXPECT_EQ(file.scalar, "");
    EXPECT_THAT(file.notes, ElementsAre("1 hidden cells left out", "1 points that no cell uses left out"));
}

TEST(Vtu, NamesTheScalarsThereAre)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    EXPECT_EQ(error_of(vtu, {.scalar = "foo"}), "no scalar \"foo\"; it has: none");
    vtu.point_arrays = {{"heat", 1, {1, 2, 3, 4, 5}}};
    vtu.cell_arrays = {{"stress", 1, {0, 0}}};
    EXPECT_EQ(error_of(vtu, {.scalar = "foo"}), "no scalar \"foo\"; it has: heat, stress (of cells)");
    EXPECT_EQ(error_of(vtu, {.scalar = "Heat"}), "no scalar \"Heat\"; it has: heat, stress (of cells)");
}

TEST(Vtu, RefusesAFileThatIsNotThere)
{
    EXPECT_EQ(reading_error(folder.file("nothing.vtu")), "there is no such file");
    std::filesystem::create_directory(folder.file("folder.vtu"));
    EXPECT_EQ(reading_error(folder.file("folder.vtu")), "not a file");
}

TEST(Vtu, RefusesAnUnknownEnding)
{
    const auto file = folder.write("mesh.abc", "solid");
    EXPECT_EQ(reading_error(file),
              "not a name of a mesh file; they end in .vtu, .vts, .vtr, .vti, .vtp, .pvtu, .pvts, .pvtr, .pvti, .pvtp, "
              ".vtm, .vtmb, .vtpc, .vtpd, .pvd, .vtk, .ex2, .e, .exo, .g, .gen, .exoii, .exii, .ex2v2, xyz.bin, .xyz, "
              ".x, .p3d, .mesh, .meshb, .msh, .obj, .off, .ply, .stl");
    EXPECT_THAT(reading_error(folder.write("mesh", "solid")), HasSubstr("not a name of a mesh file"));
    EXPECT_THAT(reading_error(folder.write("mesh.gz", "solid")), HasSubstr("not a name of a mesh file"));
}

TEST(Vtu, KnowsItsEndingInAnyCase)
{
    EXPECT_EQ(read_mesh(folder.write("MESH.VTU", vtu_of_two_tetrahedra().str())).mesh.cell_count(), 2u);
}

TEST(Vtu, RefusesAFileCutShortAnywhere)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.point_arrays = {{"heat", 1, {1, 2, 3, 4, 5}}};
    const std::string whole = vtu.str();
    const ReadOptions here{.isolated = false}; // a process for each would take long
    for (std::size_t length = 0; length < whole.size() - 2; length += 7)
        EXPECT_THAT(reading_error(folder.write("cut.vtu", whole.substr(0, length)), here), HasSubstr("cannot be read"))
            << length;
}

TEST(Vtu, RefusesWhatIsNoMesh)
{
    EXPECT_THAT(reading_error(folder.write("text.vtu", "hello")), HasSubstr("cannot be read"));
    EXPECT_THAT(reading_error(folder.write("bytes.vtu", std::string("\x01\x00\xff\n\x02", 5))),
                HasSubstr("cannot be read"));
    EXPECT_THAT(reading_error(folder.write("image.vtu", "<VTKFile type=\"ImageData\"><ImageData/></VTKFile>")),
                HasSubstr("cannot be read"));
}

TEST(Vtu, RefusesAMeshWithoutCells)
{
    EXPECT_EQ(error_of({}), "there are no cells in it");
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.cells = {{1, {0}}, {3, {1, 2}}};
    EXPECT_EQ(error_of(vtu), "there are no solid or surface cells in it");
}

TEST(Vtu, RefusesAPointThatIsNotThere)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.cells[1].points[3] = 5;
    EXPECT_EQ(error_of(vtu), "cell 1: there is no point 5");
    vtu.cells[1].points[3] = -1;
    EXPECT_EQ(error_of(vtu), "cell 1: there is no point -1");
}

TEST(Vtu, RefusesCoordinatesThatAreNotFinite)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.points[4][1] = NAN;
    EXPECT_EQ(error_of(vtu), "cell 1: coordinates of point 4 are not finite");
}

TEST(Vtu, RefusesACellWithTooFewPoints)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.cells[0].type = 12;
    EXPECT_EQ(error_of(vtu), "cell 0: a vtkHexahedron with 4 points");
}

TEST(Vtu, LeavesVtksMessagesAsTheyWere)
{
    vtkOutputWindow* const before = vtkOutputWindow::GetInstance();
    reading_error(folder.write("text.vtu", "hello"));
    EXPECT_EQ(vtkOutputWindow::GetInstance(), before);

    testing::internal::CaptureStderr();
    vtkGenericWarningMacro("still heard");
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("still heard"));
}

TEST(Vtu, ReadsFromManyThreads)
{
    const auto good = folder.write("good.vtu", vtu_of_two_tetrahedra().str());
    const auto bad = folder.write("bad.vtu", "hello");
    std::atomic<int> read = 0;
    std::atomic<int> refused = 0;
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 8; ++i)
            threads.emplace_back([&, i] {
                try {
                    read_mesh(i % 2 == 0 ? good : bad);
                    ++read;
                } catch (const InputError&) {
                    ++refused;
                }
            });
    }
    EXPECT_EQ(read, 4);
    EXPECT_EQ(refused, 4);
}
