#include "files/polyhedron.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

namespace visorder::detail {

namespace {

/// An edge of a face, from its lower to its higher point.
struct Edge {
    PointId low, high;
    std::size_t face;
    bool falls; ///< the face runs along it from the higher to the lower point

    friend bool operator<(const Edge& a, const Edge& b)
    {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    }
};

std::vector<Edge> sorted_edges(const PolyhedronFaces& faces)
{
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < faces.count(); ++i) {
        const auto face = faces.face(i);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const PointId a = face[k];
            const PointId b = face[(k + 1) % face.size()];
            edges.push_back({std::min(a, b), std::max(a, b), i, a > b});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

} // namespace

void PolyhedronFaces::add(std::span<const PointId> face_corners)
{
    const std::size_t begin = corners.size();
    for (const PointId corner : face_corners)
        if (corners.size() == begin || corners.back() != corner)
            corners.push_back(corner);
    while (corners.size() > begin + 1 && corners.back() == corners[begin])
        corners.pop_back();
    if (corners.size() - begin < 3)
        corners.resize(begin);
    else
        ends.push_back(corners.size());
}

void add_prism_faces(std::span<const PointId> corners, PolyhedronFaces& faces)
{
    const std::size_t sides = corners.size() / 2;
    std::vector<PointId> first(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(sides));
    std::reverse(first.begin(), first.end());
    faces.add(first);
    faces.add(corners.subspan(sides));
    for (std::size_t i = 0; i < sides; ++i) {
        const std::size_t next = (i + 1) % sides;
        faces.add(std::array{corners[i], corners[next], corners[sides + next], corners[sides + i]});
    }
}

bool orient_faces(PolyhedronFaces& faces)
{
    const std::vector<Edge> edges = sorted_edges(faces);
    struct Neighbour {
        std::size_t face;
        bool turned; // against this one
    };
    std::vector<std::vector<Neighbour>> neighbours(faces.count());
    if (edges.empty() || edges.size() % 2 != 0)
        return false;
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        const Edge& a = edges[i];
        const Edge& b = edges[i + 1];
        const bool third = i + 2 < edges.size() && edges[i + 2].low == a.low && edges[i + 2].high == a.high;
        if (a.low != b.low || a.high != b.high || a.face == b.face || third)
            return false;
        neighbours[a.face].push_back({b.face, a.falls == b.falls});
        neighbours[b.face].push_back({a.face, a.falls == b.falls});
    }

    enum class State : std::uint8_t { unseen, kept, turned };
    std::vector<State> states(faces.count(), State::unseen);
    std::vector<std::size_t> reached{0};
    states[0] = State::kept;
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const auto& [face, turned] : neighbours[reached[i]]) {
            const State state = (states[reached[i]] == State::turned) != turned ? State::turned : State::kept;
            if (states[face] == State::unseen) {
                states[face] = state;
                reached.push_back(face);
            } else if (states[face] != state) {
                return false;
            }
        }
    if (reached.size() != faces.count())
        return false;
    for (std::size_t i = 0; i < faces.count(); ++i)
        if (states[i] == State::turned) {
            const std::size_t begin = i == 0 ? 0 : faces.ends[i - 1];
            std::reverse(faces.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                         faces.corners.begin() + static_cast<std::ptrdiff_t>(faces.ends[i]));
        }
    return true;
}

void cut_into_tetrahedra(const PolyhedronFaces& faces, std::vector<TetrahedronCorners>& parts)
{
    if (faces.corners.empty())
        return;
    const PointId apex = *std::min_element(faces.corners.begin(), faces.corners.end());
    for (std::size_t i = 0; i < faces.count(); ++i) {
        const auto face = faces.face(i);
        const auto smallest = static_cast<std::size_t>(std::min_element(face.begin(), face.end()) - face.begin());
        if (face[smallest] == apex)
            continue;
        for (std::size_t k = 1; k + 1 < face.size(); ++k)
            parts.push_back(
                {apex, face[smallest], face[(smallest + k) % face.size()], face[(smallest + k + 1) % face.size()]});
    }
}

double sixfold_volume(const TetrahedronCorners& corners, std::span<const glm::dvec3> points)
{
    const glm::dvec3& origin = points[corners[0]];
    return glm::dot(glm::cross(points[corners[1]] - origin, points[corners[2]] - origin), points[corners[3]] - origin);
}

} // namespace visorder::detail
