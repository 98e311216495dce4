#pragma once

#include "scene/mesh.h"
#include "scene/view.h"

#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder {

/// Colours in [0, 1], row by row from the top left.
struct Picture {
    glm::ivec2 size;
    std::vector<glm::dvec3> pixels;
};

/// Paints cells one over the other in the order given, each as its silhouette in one translucent colour by its mean
/// scalar. Not a volume renderer: what it is for is to show where two orders differ. Takes cells before the eye only.
Picture paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view, double opacity);

/// The same with a colour of each cell's own, opaque, darker where a triangle is turned away.
Picture paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view,
              std::span<const glm::dvec3> colours);

/// Where two pictures of one size differ: the largest difference of a pixel's channels, times `amplification`.
Picture difference(const Picture& a, const Picture& b, double amplification);

/// Puts pictures of one height side by side with a gap.
Picture side_by_side(std::span<const Picture> pictures, int gap);

/// Throws InputError, naming the file, where it cannot be written.
void write_png(const Picture& picture, const std::filesystem::path& file);

} // namespace visorder
