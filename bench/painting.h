#pragma once

#include "visorder/image.h"
#include "visorder/mesh.h"
#include "visorder/view.h"

#include <glm/vec3.hpp>
#include <span>

namespace visorder::bench {

/// Paints cells one over the other in the order given, each as its silhouette in one translucent colour by its mean
/// scalar, over white. Not a volume renderer: what it is for is to show where two orders differ. Takes cells before the
/// eye only. Colours are for display as they are.
Image paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view, double opacity);

/// The same with a colour of each cell's own, opaque, darker where a triangle is turned away.
Image paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view,
            std::span<const glm::dvec3> colours);

/// Puts pictures of one height side by side with a white gap.
Image side_by_side(std::span<const Image> pictures, int gap);

} // namespace visorder::bench
