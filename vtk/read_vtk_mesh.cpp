#include "files/mesh_format.h"
#include "vtk/data_set_grid.h"

#include <array>

namespace visorder::detail {

namespace {

template <VtkFile (*Read)(const std::filesystem::path&, const std::string& time)>
FileGrid read_with(const std::filesystem::path& path, const ReadOptions& options)
{
    return grid_of(Read(path, options.time));
}

constexpr std::array formats{
    MeshFormat{".vtu", nullptr, read_with<read_xml_file>, true},
    MeshFormat{".vts", nullptr, read_with<read_xml_file>, true},
    MeshFormat{".vtr", nullptr, read_with<read_xml_file>, true},
    MeshFormat{".vti", nullptr, read_with<read_xml_file>, true},
    MeshFormat{".vtp", nullptr, read_with<read_xml_file>, true},
    MeshFormat{".pvtu", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".pvts", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".pvtr", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".pvti", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".pvtp", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".vtm", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".vtmb", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".vtpc", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".vtpd", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".pvd", nullptr, read_with<read_xml_file>, true, true},
    MeshFormat{".vtk", nullptr, read_with<read_legacy_file>, true},
    MeshFormat{".ex2", nullptr, read_with<read_exodus_file>, true},
    MeshFormat{".e", nullptr, read_with<read_exodus_file>, true},
    MeshFormat{".exo", nullptr, read_with<read_exodus_file>, true},
    MeshFormat{".g", nullptr, read_with<read_exodus_file>, true},
    MeshFormat{".gen", nullptr, read_with<read_exodus_file>, true},
    MeshFormat{".exoii", nullptr, read_with<read_exodus_file>, true},
    MeshFormat{".exii", nullptr, read_with<read_exodus_file>, true},
    MeshFormat{".ex2v2", nullptr, read_with<read_exodus_file>, true},
};

} // namespace

std::span<const MeshFormat> vtk_formats()
{
    return formats;
}

} // namespace visorder::detail
