#pragma once

#include "visorder/mesh.h"

#include <string>

namespace visorder::bench {

/// The tetrahedra of a volume to draw: of a file, FILE or FILE@ARRAY, where ARRAY is the scalar to take instead of the
/// format's default, or of a generated scene, NAME:SIZE[:SEED]. Throws InputError, too, for scalars that are all the
/// same, of which a transfer function over their range would show nothing, and for files in a build without readers.
Mesh volume_named(const std::string& name);

} // namespace visorder::bench
