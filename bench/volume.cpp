#include "bench/volume.h"

#include "scene/scalar_interval.h"
#include "scenes/generated_scene.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/read_mesh.h"

#include <fmt/format.h>

namespace visorder::bench {

using namespace detail;

using namespace scenes;

namespace {

Mesh mesh_named(const std::string& name)
{
    if (name.find(':') != std::string::npos)
        return generate(name);
    const std::size_t at = name.rfind('@');
    ReadOptions options;
    if (at != std::string::npos)
        options.scalar = name.substr(at + 1);
    return read_mesh(name.substr(0, at), options).mesh;
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
