#include "scenes/views.h"

#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scenes/portable_numbers.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace visorder::scenes {

using namespace detail;

namespace {

double radius_of(const Scene& scene)
{
    const double radius = glm::length(scene.bounds().max * 0.5 - scene.bounds().min * 0.5);
    return radius > 0 ? radius : 1;
}

std::string words(const char* what, const glm::dvec3& p)
{
    return fmt::format("{} {:.17g},{:.17g},{:.17g}", what, p.x, p.y, p.z);
}

class Viewpoints {
public:
    Viewpoints(const Scene& scene, glm::ivec2 size, const std::optional<glm::dvec3>& up)
        : middle_(scene.bounds().middle()),
          radius_(radius_of(scene)),
          size_(size),
          upright_(up ? Upright{*up, false} : upright_for(scene.bounds()))
    {
    }

    NamedView from(const char* what, const glm::dvec3& eye) const
    {
        // An eye at the very middle looks down an axis.
        const glm::dvec3 target = eye == middle_ ? eye - glm::dvec3(0, 0, radius_) : middle_;
        return {words(what, eye), look_at(eye, target, radius_, 45, size_, upright_)};
    }
    NamedView along(const char* what, const glm::dvec3& towards_viewer) const
    {
        return {words(what, towards_viewer), parallel(towards_viewer, middle_, radius_, size_, upright_)};
    }

    const glm::dvec3& middle() const { return middle_; }
    double radius() const { return radius_; }

private:
    glm::dvec3 middle_;
    double radius_;
    glm::ivec2 size_;
    Upright upright_;
};

glm::dvec3 mean_of(const Mesh& mesh, std::span<const PointId> vertices)
{
    glm::dvec3 sum(0);
    for (PointId v : vertices)
        sum += mesh.points[v] / static_cast<double>(vertices.size());
    return sum;
}

} // namespace

std::vector<NamedView> random_views(const Scene& scene, int count, std::uint64_t seed, glm::ivec2 size,
                                    const std::optional<glm::dvec3>& up)
{
    const Viewpoints viewpoints(scene, size, up);
    Random random(seed);
    const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    std::vector<NamedView> views;
    for (int i = 0; i < count; ++i) {
        glm::dvec3 direction;
        double square;
        do {
            direction = {between(-1, 1), between(-1, 1), between(-1, 1)};
            square = glm::dot(direction, direction);
        } while (square > 1 || square < 0.01);
        direction /= std::sqrt(square);
        const double distance = viewpoints.radius() * between(2, 4);
        views.push_back(i % 2 == 0 ? viewpoints.from("eye", viewpoints.middle() + distance * direction)
                                   : viewpoints.along("direction", direction));
    }
    return views;
}

std::vector<NamedView> hard_views(const Scene& scene, glm::ivec2 size, const std::optional<glm::dvec3>& up)
{
    const Viewpoints viewpoints(scene, size, up);
    const Mesh& mesh = scene.mesh();
    const Box& box = scene.bounds();
    const auto middle_cell = scene.cell_count() / 2;
    const glm::dvec3 in_a_cell = mean_of(mesh, mesh.cell(middle_cell));
    const glm::dvec3 vertex = mesh.points[mesh.cell(middle_cell)[0]];
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));

    std::vector<NamedView> views{
        viewpoints.from("at a vertex", vertex),
        viewpoints.from("in a cell", in_a_cell),
        viewpoints.from("at a corner of the box", box.max),
        viewpoints.from("in the planes of a vertex, outside", {vertex.x, vertex.y, box.max.z + viewpoints.radius()}),
        viewpoints.from("a trillionth of the box away", box.max + 1e-12 * viewpoints.radius()),
        viewpoints.from("a billion boxes away", viewpoints.middle() + 1e9 * viewpoints.radius() * direction),
    };
    for (int face = 0; face < face_count(mesh.shapes[middle_cell]); ++face) {
        const FaceLoop loop = face_loop(mesh, middle_cell, face);
        if (loop.count > 0 && (scene.adjacency().interior[middle_cell] >> face & 1u) != 0) {
            views.push_back(viewpoints.from("on an interior face", mean_of(mesh, {loop.begin(), loop.end()})));
            break;
        }
    }
    if (!scene.boundary().faces.empty()) {
        const CellFace face = scene.boundary().faces[scene.boundary().faces.size() / 2];
        const FaceLoop loop = face_loop(mesh, face.cell, static_cast<int>(face.face));
        views.push_back(viewpoints.from("on a boundary face", mean_of(mesh, {loop.begin(), loop.end()})));
    }
    for (int axis = 0; axis < 3; ++axis)
        for (double sign : {1.0, -1.0}) {
            glm::dvec3 towards(0);
            towards[axis] = sign;
            views.push_back(viewpoints.along("along", towards));
        }
    return views;
}

} // namespace visorder::scenes
