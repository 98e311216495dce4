#include "files/mesh_format.h"
#include "vtk/data_set_grid.h"

#include <array>

namespace visorder {

namespace {

template <VtkFile (*Read)(const std::filesystem::path&, const std::string& time)>
FileGrid read_with(const std::filesystem::path& path, const ReadOptions& options)
{
    return grid_of(Read(path, options.time));
}

constexpr std::array formats{
    MeshFormat{".vtu", nullptr, read_with<read_xml_file>},
    MeshFormat{".vts", nullptr, read_with<read_xml_file>},
    MeshFormat{".vtr", nullptr, read_with<read_xml_file>},
    MeshFormat{".vti", nullptr, read_with<read_xml_file>},
    MeshFormat{".vtp", nullptr, read_with<read_xml_file>},
    MeshFormat{".pvtu", nullptr, read_with<read_xml_file>},
    MeshFormat{".pvts", nullptr, read_with<read_xml_file>},
    MeshFormat{".pvtr", nullptr, read_with<read_xml_file>},
    MeshFormat{".pvti", nullptr, read_with<read_xml_file>},
    MeshFormat{".pvtp", nullptr, read_with<read_xml_file>},
    MeshFormat{".vtm", nullptr, read_with<read_xml_file>},
    MeshFormat{".vtmb", nullptr, read_with<read_xml_file>},
    MeshFormat{".vtpc", nullptr, read_with<read_xml_file>},
    MeshFormat{".vtpd", nullptr, read_with<read_xml_file>},
    MeshFormat{".pvd", nullptr, read_with<read_xml_file>},
    MeshFormat{".vtk", nullptr, read_with<read_legacy_file>},
    MeshFormat{".ex2", nullptr, read_with<read_exodus_file>},
    MeshFormat{".e", nullptr, read_with<read_exodus_file>},
    MeshFormat{".exo", nullptr, read_with<read_exodus_file>},
    MeshFormat{".g", nullptr, read_with<read_exodus_file>},
    MeshFormat{".gen", nullptr, read_with<read_exodus_file>},
    MeshFormat{".exoii", nullptr, read_with<read_exodus_file>},
    MeshFormat{".exii", nullptr, read_with<read_exodus_file>},
    MeshFormat{".ex2v2", nullptr, read_with<read_exodus_file>},
};

} // namespace

std::span<const MeshFormat> vtk_formats()
{
    return formats;
}

} // namespace visorder
