#pragma once

#include "visorder/mesh.h"

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <random>
#include <vector>

namespace visorder::tests {

using FaceKey = std::array<PointId, 4>;

struct Owner {
    CellId cell;
    int face;
};

/// The owners of every face, by its vertices, sorted; found by brute force.
std::map<FaceKey, std::vector<Owner>> owners_of_faces(const Mesh& mesh);

using Relations = std::vector<std::vector<CellId>>;

/// For each cell those that it obstructs across a face. For faces that are planar: three of the vertices tell.
Relations relations_across_faces(const Mesh& mesh, const glm::dvec4& eye);

/// Of unit length.
glm::dvec3 random_direction(std::mt19937_64& random);

} // namespace visorder::tests
