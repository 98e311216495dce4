#include "tests/fuzz/seeds.h"
#include "tests/temporary_folder.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataSetWriter.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtk_netcdf.h>

namespace visorder::tests {

namespace {

/// Two layers of points over a square, and cells of all kinds between them.
vtkSmartPointer<vtkUnstructuredGrid> grid_of_many_kinds(bool polyhedra)
{
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    const vtkNew<vtkPoints> points;
    for (int z = 0; z < 3; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x)
                points->InsertNextPoint(x, y, z);
    points->InsertNextPoint(0.5, 0.5, 5);
    grid->SetPoints(points);
    const auto add = [&](int type, const std::vector<vtkIdType>& ids) {
        grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    };
    add(VTK_HEXAHEDRON, {0, 1, 4, 3, 9, 10, 13, 12});
    add(VTK_VOXEL, {1, 2, 4, 5, 10, 11, 13, 14});
    add(VTK_WEDGE, {3, 4, 6, 12, 13, 15});
    add(VTK_TETRA, {4, 7, 6, 16});
    add(VTK_PYRAMID, {9, 10, 13, 12, 27});
    add(VTK_QUADRATIC_TETRA, {4, 5, 7, 13, 5, 8, 7, 14, 14, 16});
    add(VTK_TRIANGLE, {0, 1, 2});
    add(VTK_POLYGON, {0, 1, 2, 5, 4});
    add(VTK_LINE, {0, 1});
    if (polyhedra) {
        const std::vector<vtkIdType> corners{18, 19, 22, 21};
        const std::vector<vtkIdType> faces{3, 18, 19, 22, 3, 18, 22, 21, 3, 18, 21, 19, 3, 19, 21, 22};
        grid->InsertNextCell(VTK_POLYHEDRON, 4, corners.data(), 4, faces.data());
    }
    const vtkNew<vtkFloatArray> values;
    values->SetName("temperature");
    const vtkNew<vtkDoubleArray> vectors;
    vectors->SetName("velocity");
    vectors->SetNumberOfComponents(3);
    for (int i = 0; i < points->GetNumberOfPoints(); ++i) {
        values->InsertNextValue(static_cast<float>(i));
        vectors->InsertNextTuple3(i, 2 * i, 3 * i);
    }
    grid->GetPointData()->SetScalars(values);
    grid->GetPointData()->AddArray(vectors);
    const vtkNew<vtkIntArray> materials;
    materials->SetName("material");
    for (int i = 0; i < grid->GetNumberOfCells(); ++i)
        materials->InsertNextValue(i % 3);
    grid->GetCellData()->AddArray(materials);
    const vtkNew<vtkIdTypeArray> ids;
    ids->SetName("ids");
    for (int i = 0; i < grid->GetNumberOfCells(); ++i)
        ids->InsertNextValue(i);
    grid->GetCellData()->SetGlobalIds(ids);
    return grid;
}

std::vector<vtkSmartPointer<vtkDataSet>> other_data_sets()
{
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(3, 2, 2);
    image->AllocateScalars(VTK_FLOAT, 1);
    for (int i = 0; i < 12; ++i)
        image->GetPointData()->GetScalars()->SetComponent(i, 0, i);

    const auto axis = [](int n) {
        auto values = vtkSmartPointer<vtkDoubleArray>::New();
        for (int i = 0; i < n; ++i)
            values->InsertNextValue(i);
        return values;
    };
    auto rectilinear = vtkSmartPointer<vtkRectilinearGrid>::New();
    rectilinear->SetDimensions(3, 2, 2);
    rectilinear->SetXCoordinates(axis(3));
    rectilinear->SetYCoordinates(axis(2));
    rectilinear->SetZCoordinates(axis(2));

    auto structured = vtkSmartPointer<vtkStructuredGrid>::New();
    structured->SetDimensions(3, 2, 2);
    const vtkNew<vtkPoints> points;
    for (int i = 0; i < 12; ++i)
        points->InsertNextPoint(image->GetPoint(i));
    structured->SetPoints(points);
    structured->GetPointData()->ShallowCopy(image->GetPointData());

    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(points);
    const auto cells = [](const std::vector<vtkIdType>& ids) {
        auto array = vtkSmartPointer<vtkCellArray>::New();
        array->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
        return array;
    };
    surface->SetVerts(cells({0}));
    surface->SetLines(cells({0, 1, 2}));
    surface->SetPolys(cells({0, 1, 4, 3}));
    surface->SetStrips(cells({6, 7, 9, 10, 8}));
    const vtkNew<vtkStringArray> names;
    names->SetName("names");
    for (int i = 0; i < 4; ++i)
        names->InsertNextValue(fmt::format("cell {}", i));
    surface->GetCellData()->AddArray(names);
    return {image, rectilinear, structured, surface};
}

void add_legacy_seeds(std::vector<Seed>& seeds, vtkDataSet& data, const std::string& name)
{
    for (const int version :
         {vtkDataSetWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataSetWriter::VTK_LEGACY_READER_VERSION_5_1})
        for (const bool binary : {false, true}) {
            const vtkNew<vtkDataSetWriter> writer;
            writer->SetInputData(&data);
            writer->WriteToOutputStringOn();
            writer->SetFileVersion(version);
            binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
            writer->Write();
            seeds.push_back({fmt::format("{}_{}_{}.vtk", name, version, binary ? "binary" : "ascii"),
                             writer->GetOutputStdString()});
        }
}

void add_vtu_seeds(std::vector<Seed>& seeds, vtkUnstructuredGrid& data, const std::string& name)
{
    const auto add = [&](const std::string& kind, auto configure) {
        const vtkNew<vtkXMLUnstructuredGridWriter> writer;
        writer->SetInputData(&data);
        writer->WriteToOutputStringOn();
        writer->SetCompressorTypeToNone();
        configure(*writer);
        writer->Write();
        seeds.push_back({fmt::format("{}_{}.vtu", name, kind), writer->GetOutputString()});
    };
    add("ascii", [](auto& writer) { writer.SetDataModeToAscii(); });
    add("base64", [](auto& writer) { writer.SetDataModeToBinary(); });
    add("base64_zlib", [](auto& writer) {
        writer.SetDataModeToBinary();
        writer.SetCompressorTypeToZLib();
    });
    add("appended", [](auto& writer) { writer.SetDataModeToAppended(); });
    add("raw", [](auto& writer) {
        writer.SetDataModeToAppended();
        writer.EncodeAppendedDataOff();
        writer.SetHeaderTypeToUInt64();
    });
    for (const char* compressor : {"zlib", "lz4", "lzma"})
        add(fmt::format("raw_{}", compressor), [&](auto& writer) {
            writer.SetDataModeToAppended();
            writer.EncodeAppendedDataOff();
            writer.SetHeaderTypeToUInt32();
            writer.SetBlockSize(64); // several blocks per array
            compressor == std::string("zlib")  ? writer.SetCompressorTypeToZLib()
            : compressor == std::string("lz4") ? writer.SetCompressorTypeToLZ4()
                                               : writer.SetCompressorTypeToLZMA();
        });
}

/// A hexahedron and a tetrahedron in two blocks, with a nodal variable at two times, as Exodus II has it.
std::string exodus_content(int format)
{
    const TemporaryFolder folder;
    const std::string path = folder.file("mesh.e").string();
    int id = 0;
    nc_create(path.c_str(), format, &id);
    const auto dimension = [&](const char* name, std::size_t length) {
        int result = 0;
        nc_def_dim(id, name, length, &result);
        return result;
    };
    const int text = dimension("len_string", 33), time = dimension("time_step", NC_UNLIMITED),
              nodes = dimension("num_nodes", 9), blocks = dimension("num_el_blk", 2),
              variables = dimension("num_nod_var", 1), hexahedra = dimension("num_el_in_blk1", 1),
              hexahedron_nodes = dimension("num_nod_per_el1", 8), tetrahedra = dimension("num_el_in_blk2", 1),
              tetrahedron_nodes = dimension("num_nod_per_el2", 4);
    dimension("len_line", 81);
    dimension("num_elem", 2);
    dimension("num_dim", 3);
    const auto variable = [&](const char* name, nc_type type, const std::vector<int>& dimensions) {
        int result = 0;
        nc_def_var(id, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &result);
        return result;
    };
    const int times = variable("time_whole", NC_DOUBLE, {time}), status = variable("eb_status", NC_INT, {blocks}),
              ids = variable("eb_prop1", NC_INT, {blocks}), x = variable("coordx", NC_DOUBLE, {nodes}),
              y = variable("coordy", NC_DOUBLE, {nodes}), z = variable("coordz", NC_DOUBLE, {nodes}),
              first = variable("connect1", NC_INT, {hexahedra, hexahedron_nodes}),
              second = variable("connect2", NC_INT, {tetrahedra, tetrahedron_nodes}),
              names = variable("name_nod_var", NC_CHAR, {variables, text}),
              values = variable("vals_nod_var1", NC_DOUBLE, {time, nodes});
    const float version = 5.1f;
    const int words = 8, size = 1;
    nc_put_att_float(id, NC_GLOBAL, "api_version", NC_FLOAT, 1, &version);
    nc_put_att_float(id, NC_GLOBAL, "version", NC_FLOAT, 1, &version);
    nc_put_att_int(id, NC_GLOBAL, "floating_point_word_size", NC_INT, 1, &words);
    nc_put_att_int(id, NC_GLOBAL, "file_size", NC_INT, 1, &size);
    nc_put_att_text(id, NC_GLOBAL, "title", 4, "mesh");
    nc_put_att_text(id, ids, "name", 2, "ID");
    nc_put_att_text(id, first, "elem_type", 4, "HEX8");
    nc_put_att_text(id, second, "elem_type", 5, "TETRA");
    nc_enddef(id);
    const std::vector<double> xs{0, 1, 1, 0, 0, 1, 1, 0, 2}, ys{0, 0, 1, 1, 0, 0, 1, 1, 0},
        zs{0, 0, 0, 0, 1, 1, 1, 1, 0};
    const std::vector<int> ones{1, 1}, numbers{1, 2}, hexahedron{1, 2, 3, 4, 5, 6, 7, 8}, tetrahedron{2, 9, 3, 6};
    nc_put_var_double(id, x, xs.data());
    nc_put_var_double(id, y, ys.data());
    nc_put_var_double(id, z, zs.data());
    nc_put_var_int(id, status, ones.data());
    nc_put_var_int(id, ids, numbers.data());
    nc_put_var_int(id, first, hexahedron.data());
    nc_put_var_int(id, second, tetrahedron.data());
    std::string name = "temperature";
    name.resize(33);
    nc_put_var_text(id, names, name.data());
    for (std::size_t step = 0; step < 2; ++step) {
        const double at = static_cast<double>(step);
        nc_put_var1_double(id, times, &step, &at);
        const std::size_t start[]{step, 0}, count[]{1, 9};
        nc_put_vara_double(id, values, start, count, xs.data());
    }
    nc_close(id);
    return content_of(path);
}

} // namespace

std::vector<Seed> vtk_seeds()
{
    std::vector<Seed> seeds;
    for (const bool polyhedra : {false, true}) {
        const std::string name = polyhedra ? "polyhedra" : "kinds";
        const auto grid = grid_of_many_kinds(polyhedra);
        add_legacy_seeds(seeds, *grid, name);
        add_vtu_seeds(seeds, *grid, name);
    }
    for (const auto& data : other_data_sets())
        add_legacy_seeds(seeds, *data, data->GetClassName());
    for (const auto& [name, format] :
         {std::pair{"classic", 0}, std::pair{"offset64", NC_64BIT_OFFSET}, std::pair{"netcdf4", NC_NETCDF4}})
        seeds.push_back({fmt::format("{}.e", name), exodus_content(format)});
    return seeds;
}

} // namespace visorder::tests
