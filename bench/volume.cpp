#include "bench/volume.h"

#include "bench/generated_scene.h"
#include "scene/error.h"
#include "scene/scalar_interval.h"
#include "scene/subdivision.h"
#if defined(VISORDER_WITH_VTK)
#include "vtk/read_mesh.h"
#endif

#include <fmt/format.h>

namespace visorder::bench {

using namespace scenes;

namespace {

Mesh mesh_named(const std::string& name)
{
    if (name.find(':') != std::string::npos)
        return generate(name);
#if defined(VISORDER_WITH_VTK)
    const std::size_t at = name.rfind('@');
    ReadOptions options;
    if (at != std::string::npos)
        options.scalar = name.substr(at + 1);
    return read_mesh(name.substr(0, at), options).mesh;
#else
    throw InputError(fmt::format("{}: this build reads no files, for it is without VTK", name));
#endif
}

} // namespace

Mesh volume_named(const std::string& name)
{
    Mesh mesh = subdivide(mesh_named(name)).mesh;
    if (const auto scalars = scalar_interval(mesh); !scalars || scalars->width() == 0)
        throw InputError(fmt::format("{}: scalars are all the same; choose another array, as FILE@ARRAY", name));
    return mesh;
}

} // namespace visorder::bench
