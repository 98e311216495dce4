#include "files/mesh_format.h"
#include "vtk/data_set_mesh.h"

#include <array>

namespace visorder {

namespace {

template <VtkFile (*Read)(const std::filesystem::path&)>
MeshFile read_with(const std::filesystem::path& path, const ReadOptions& options)
{
    return mesh_of(Read(path), options.scalar);
}

constexpr std::array formats{
    MeshFormat{".vtu", read_with<read_xml_file>, true},    MeshFormat{".vtk", read_with<read_legacy_file>, true},
    MeshFormat{".ex2", read_with<read_exodus_file>, true}, MeshFormat{".e", read_with<read_exodus_file>, true},
    MeshFormat{".exo", read_with<read_exodus_file>, true}, MeshFormat{"xyz.bin", read_with<read_plot3d_file>},
};

} // namespace

std::span<const MeshFormat> vtk_formats()
{
    return formats;
}

} // namespace visorder
