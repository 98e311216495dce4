#include "scene/relation_faces.h"

#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "visorder/scene.h"

#include <algorithm>

namespace visorder::detail {

namespace {

std::vector<CellId> cells_that_overlap(const Scene& scene)
{
    std::vector<CellId> cells;
    for (const auto& [a, b] : scene.overlapping_cells())
        cells.insert(cells.end(), {a, b});
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

// The faces of solid cells on the other side of an interior face.
void add_faces_across(const Scene& scene, CellId cell, int face, std::vector<CellFace>& faces)
{
    const CellId neighbour = scene.adjacency().row(cell)[static_cast<std::size_t>(face)];
    if (neighbour == cell)
        return;
    if (scene.orientations().sign[neighbour] != 0) {
        faces.push_back({neighbour, static_cast<std::uint32_t>(matching_face(scene, cell, face))});
        return;
    }
    // The neighbour is flat and lies between solids: those beyond it meet the cell too.
    for (int other = 0; other < face_count(scene.mesh().shapes[neighbour]); ++other) {
        const CellId beyond = scene.adjacency().row(neighbour)[static_cast<std::size_t>(other)];
        if (beyond != neighbour)
            faces.push_back({beyond, static_cast<std::uint32_t>(matching_face(scene, neighbour, other))});
    }
}

} // namespace

std::vector<CellFace> derive_relation_faces(const Scene& scene)
{
    std::vector<CellFace> faces = scene.boundary().faces;
    const std::vector<CellId> cells = cells_that_overlap(scene);
    if (cells.empty())
        return faces;
    for (const CellId cell : cells)
        for (int face = 0; face < face_count(scene.mesh().shapes[cell]); ++face) {
            if (face_loop(scene.mesh(), cell, face).count < 3)
                continue;
            faces.push_back({cell, static_cast<std::uint32_t>(face)});
            add_faces_across(scene, cell, face, faces);
        }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

} // namespace visorder::detail
