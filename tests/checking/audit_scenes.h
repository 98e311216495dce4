#pragma once

#include "visorder/mesh.h"

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

namespace visorder::tests {

/// A scene that is hard to order, and eyes from which it is. Solids are convex with planar faces.
struct AuditScene {
    Mesh mesh;
    std::vector<glm::dvec4> eyes; ///< homogeneous
};

/// A kind of hard scenes: an endless sequence, the same on every machine.
struct AuditKind {
    const char* name;
    const char* summary;                       ///< one line
    AuditScene (*scene)(std::uint64_t number); ///< number >= 1
};

/// Overlaps by one ulp, flat cells, hanging nodes, contact, bars, cavities, surfaces, mixed cells, inverted cells,
/// duplicated points, and magnitudes from subnormal to 1e300. The eyes are of all the degenerate kinds: at a vertex, on
/// a face, inside a cell, at and 1e-12 box sizes off a corner of the bounding box, in the plane of many faces, 1e9 box
/// sizes away, along the axes; and random ones.
std::span<const AuditKind> audit_kinds();

/// The mesh as text of a VTK legacy file, every coordinate in as many digits as tell it apart.
std::string vtk_text(const Mesh& mesh, const std::string& title);

} // namespace visorder::tests
