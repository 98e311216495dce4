#include "scene/adjacency.h"

#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <stdexcept>

namespace visorder::detail {

namespace {

using Range = oneapi::tbb::blocked_range<std::uint32_t>;

// A face by its vertices in ascending order. Faces are grouped by the lowest one; `others` tells those of a group
// apart.
struct FaceKey {
    PointId lowest;
    std::array<PointId, 3> others; // unused places hold `no_point`
};

constexpr PointId no_point = 0xffffffffu;

std::optional<FaceKey> face_key(const Mesh& mesh, CellId cell, int face, int least)
{
    FaceLoop loop = face_loop(mesh, cell, face);
    if (loop.count < least)
        return std::nullopt;
    std::sort(loop.vertices.begin(), loop.vertices.begin() + loop.count);
    FaceKey key{loop.vertices[0], {no_point, no_point, no_point}};
    std::copy(loop.vertices.begin() + 1, loop.vertices.begin() + loop.count, key.others.begin());
    return key;
}

std::optional<FaceKey> tetrahedron_face_key(const PointId* v, int face)
{
    constexpr std::array<std::array<int, 3>, 4> corners{{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}};
    const auto& [i, j, k] = corners[static_cast<std::size_t>(face)];
    const PointId a = v[i], b = v[j], c = v[k];
    const PointId low = std::min({a, b, c}), high = std::max({a, b, c});
    // The middle one is what remains of the three; unsigned sums wrap and unwrap.
    return FaceKey{low, {a + b + c - low - high, high, no_point}};
}

// Half faces (cell * row_length + face) grouped by the lowest vertex of their face.
struct Groups {
    LargeArray<std::uint32_t> begin; // of each point's group, and the end of the last
    LargeArray<std::uint32_t> half_faces;
};

template <class Key>
Groups group_half_faces(const Mesh& mesh, std::uint32_t row_length, Key&& key)
{
    const auto cells = static_cast<std::uint32_t>(mesh.cell_count());
    Groups groups;
    groups.begin.resize(mesh.points.size() + 1);
    std::fill(groups.begin.begin(), groups.begin.end(), 0u);
    const auto each_face = [&](auto&& visit) {
        oneapi::tbb::parallel_for(Range(0, cells, 4096), [&](const Range& range) {
            for (CellId cell = range.begin(); cell < range.end(); ++cell) {
                if (is_collapsed(mesh, cell))
                    continue;
                const int faces = face_count(mesh.shapes[cell]);
                for (int face = 0; face < faces; ++face)
                    if (const auto k = key(cell, face))
                        visit(k->lowest, cell * row_length + static_cast<std::uint32_t>(face));
            }
        });
    };
    const auto at = [&](PointId point) { return std::atomic_ref(groups.begin[point]); };
    each_face([&](PointId lowest, std::uint32_t) { at(lowest).fetch_add(1, std::memory_order_relaxed); });
    std::uint32_t end = 0;
    for (std::uint32_t& count : groups.begin) {
        end += count;
        count = end;
    }
    groups.half_faces.resize(end);
    // Filled from each group's end, so that its counter comes to rest on its beginning.
    each_face([&](PointId lowest, std::uint32_t half_face) {
        groups.half_faces[at(lowest).fetch_sub(1, std::memory_order_relaxed) - 1] = half_face;
    });
    return groups;
}

// Collects the half faces of faces that more than two cells share, three at a time, from several threads.
class CrowdedFaces {
public:
    explicit CrowdedFaces(std::uint32_t row_length) : row_length_(row_length) {}

    void found(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        const std::lock_guard lock(mutex_);
        triples_.push_back({a, b, c}); // the first two are the same in all triples of one face
    }

    /// The cells of each face, ascending, whatever the threads did.
    std::vector<std::vector<CellId>> cells_of_faces()
    {
        std::sort(triples_.begin(), triples_.end());
        std::vector<std::vector<CellId>> faces;
        for (std::size_t i = 0; i < triples_.size(); ++i) {
            const auto& [a, b, c] = triples_[i];
            if (i == 0 || triples_[i - 1][0] != a || triples_[i - 1][1] != b)
                faces.push_back({a / row_length_, b / row_length_});
            faces.back().push_back(c / row_length_);
        }
        for (std::vector<CellId>& cells : faces) {
            std::sort(cells.begin(), cells.end());
            cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        }
        std::sort(faces.begin(), faces.end());
        return faces;
    }

private:
    std::uint32_t row_length_;
    std::mutex mutex_;
    std::vector<std::array<std::uint32_t, 3>> triples_;
};

struct Entry {
    std::array<PointId, 3> others;
    std::uint32_t half_face;
};

// The half faces of one group; `join` gets the two of every face that two share, and may get two of one that more do;
// `shared_by_three` gets of that the same first two with each of the others.
class Matching {
public:
    void clear()
    {
        entries_.clear();
        keys_.clear();
    }
    void add(const FaceKey& key, std::uint32_t half_face)
    {
        entries_.push_back({key.others, half_face});
        keys_.push_back(std::uint64_t{key.others[0]} << 32 | key.others[1]);
    }

    template <class Join, class Shared>
    void join_equal(Join&& join, Shared&& shared_by_three)
    {
        if (entries_.size() <= few)
            join_by_comparing(join, shared_by_three);
        else
            join_by_sorting(join, shared_by_three);
    }

private:
    // A point of a tetrahedral mesh is the lowest of some 26 half faces: comparing all pairs beats sorting them.
    static constexpr std::size_t few = 64;

    template <class Join, class Shared>
    void join_by_comparing(Join&& join, Shared&& shared_by_three)
    {
        std::array<std::uint8_t, few> partner{}; // 1 + its index
        for (std::size_t i = 1; i < entries_.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) {
                if (keys_[k] != keys_[i] || entries_[k].others[2] != entries_[i].others[2])
                    continue;
                if (partner[k] != 0) {
                    shared_by_three(entries_[k].half_face, entries_[partner[k] - 1u].half_face, entries_[i].half_face);
                } else {
                    partner[k] = static_cast<std::uint8_t>(i + 1);
                    partner[i] = static_cast<std::uint8_t>(k + 1);
                    join(entries_[k].half_face, entries_[i].half_face);
                }
                break;
            }
    }

    template <class Join, class Shared>
    void join_by_sorting(Join&& join, Shared&& shared_by_three)
    {
        std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.others < b.others; });
        for (std::size_t i = 0; i < entries_.size();) {
            std::size_t end = i + 1;
            while (end < entries_.size() && entries_[end].others == entries_[i].others)
                ++end;
            if (end - i == 2)
                join(entries_[i].half_face, entries_[i + 1].half_face);
            else if (end - i > 2)
                for (std::size_t third = i + 2; third < end; ++third)
                    shared_by_three(entries_[i].half_face, entries_[i + 1].half_face, entries_[third].half_face);
            i = end;
        }
    }

    std::vector<Entry> entries_;
    std::vector<std::uint64_t> keys_;
};

template <class Key>
Adjacency adjacency_by(const Scene& scene, std::uint32_t row_length, Key&& key)
{
    const Mesh& mesh = scene.mesh();
    const auto cells = scene.cell_count();
    Adjacency adjacency;
    adjacency.row_length = static_cast<int>(row_length);
    adjacency.neighbour.resize(std::size_t{cells} * row_length);
    adjacency.interior.resize(cells);
    oneapi::tbb::parallel_for(Range(0, cells, 4096), [&](const Range& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            std::fill_n(adjacency.neighbour.data() + std::size_t{cell} * row_length, row_length, cell);
    });

    const Groups groups = group_half_faces(mesh, row_length, key);
    CrowdedFaces crowded(row_length);
    // What three or more share joins none; its first two may have been joined when the third had not been seen.
    const auto join_none = [&](auto... half_faces) {
        ((adjacency.neighbour[half_faces] = half_faces / row_length), ...);
    };
    oneapi::tbb::parallel_for(Range(0, static_cast<std::uint32_t>(mesh.points.size()), 256), [&](const Range& range) {
        Matching group;
        for (PointId point = range.begin(); point < range.end(); ++point) {
            group.clear();
            for (std::uint32_t i = groups.begin[point]; i < groups.begin[point + 1]; ++i) {
                const std::uint32_t half_face = groups.half_faces[i];
                group.add(*key(half_face / row_length, static_cast<int>(half_face % row_length)), half_face);
            }
            group.join_equal(
                [&](std::uint32_t a, std::uint32_t b) {
                    adjacency.neighbour[a] = b / row_length;
                    adjacency.neighbour[b] = a / row_length;
                },
                [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                    join_none(a, b, c);
                    if (!scene.is_surface())
                        crowded.found(a, b, c);
                });
        }
    });
    adjacency.crowded = crowded.cells_of_faces();

    oneapi::tbb::parallel_for(Range(0, cells, 4096), [&](const Range& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell) {
            std::uint32_t bits = 0;
            for (std::uint32_t face = 0; face < row_length; ++face)
                bits |= std::uint32_t{adjacency.neighbour[std::size_t{cell} * row_length + face] != cell} << face;
            adjacency.interior[cell] = static_cast<std::uint8_t>(bits);
        }
    });
    return adjacency;
}

// Whether two loops of the same vertices run round the same way.
bool same_way(const FaceLoop& a, const FaceLoop& b)
{
    const auto next_of = [](const FaceLoop& loop, PointId v) {
        const PointId* at = std::find(loop.begin(), loop.end(), v);
        return at + 1 == loop.end() ? *loop.begin() : *(at + 1);
    };
    return next_of(a, *a.begin()) == next_of(b, *a.begin());
}

bool same_vertices(const FaceLoop& a, const FaceLoop& b)
{
    return a.count == b.count &&
           std::all_of(a.begin(), a.end(), [&](PointId v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

// A face of a tetrahedron with four distinct vertices needs no search for repeated ones.
FaceLoop loop_of(const Mesh& mesh, CellId cell, int face)
{
    if (mesh.shapes[cell] != CellShape::tetrahedron)
        return face_loop(mesh, cell, face);
    const auto v = mesh.cell(cell);
    const auto corners = face_vertices(CellShape::tetrahedron, face);
    return {{v[corners[0]], v[corners[1]], v[corners[2]], 0}, 3};
}

int matching_face_in(const Mesh& mesh, const Adjacency& adjacency, CellId cell, int face)
{
    const CellId neighbour = adjacency.row(cell)[static_cast<std::size_t>(face)];
    const FaceLoop loop = loop_of(mesh, cell, face);
    const auto row = adjacency.row(neighbour);
    for (int other = 0; other < face_count(mesh.shapes[neighbour]); ++other)
        if (row[static_cast<std::size_t>(other)] == cell && same_vertices(loop, loop_of(mesh, neighbour, other)))
            return other;
    throw std::logic_error("adjacency joins cells that share no face");
}

// The faces of joined solid cells that lie on the same side of them.
std::vector<CellFace> find_folded(const Scene& scene, const Adjacency& adjacency)
{
    const Mesh& mesh = scene.mesh();
    const auto& sign = scene.orientations().sign;
    std::mutex mutex;
    std::vector<CellFace> folded;
    oneapi::tbb::parallel_for(Range(0, scene.cell_count(), 4096), [&](const Range& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell) {
            const auto row = adjacency.row(cell);
            for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
                const CellId neighbour = row[static_cast<std::size_t>(face)];
                // Of the two cells the one with the lower number looks at their face for both.
                if (neighbour <= cell || sign[cell] == 0 || sign[neighbour] == 0)
                    continue;
                const int other = matching_face_in(mesh, adjacency, cell, face);
                // On opposite sides of a face, two cells run round it in opposite ways, both taken from outside.
                if (same_way(loop_of(mesh, cell, face), loop_of(mesh, neighbour, other)) !=
                    (sign[cell] == sign[neighbour]))
                    continue;
                const std::lock_guard lock(mutex);
                folded.push_back({cell, static_cast<std::uint32_t>(face)});
                folded.push_back({neighbour, static_cast<std::uint32_t>(other)});
            }
        }
    });
    std::sort(folded.begin(), folded.end());
    return folded;
}

// Whether all faces of a flat tetrahedron that have area, and no others, are shared with solid cells.
bool lies_between_solids(const Scene& scene, const Adjacency& adjacency, CellId flat)
{
    const Mesh& mesh = scene.mesh();
    if (mesh.shapes[flat] != CellShape::tetrahedron || is_collapsed(mesh, flat))
        return false;
    for (int face = 0; face < 4; ++face) {
        const CellId neighbour = adjacency.row(flat)[static_cast<std::size_t>(face)];
        const bool has_area = spanning_triple(mesh, loop_of(mesh, flat, face)).has_value();
        if (has_area != (neighbour != flat && scene.orientations().sign[neighbour] != 0))
            return false;
    }
    return true;
}

// The faces at which flat cells are cut off from their neighbours, from both sides.
std::vector<CellFace> faces_of_stray_flats(const Scene& scene, const Adjacency& adjacency)
{
    const Mesh& mesh = scene.mesh();
    std::vector<CellFace> faces;
    for (CellId cell = 0; scene.orientations().flat > 0 && cell < scene.cell_count(); ++cell) {
        if (scene.orientations().sign[cell] != 0 || adjacency.interior[cell] == 0 ||
            lies_between_solids(scene, adjacency, cell))
            continue;
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
            const CellId neighbour = adjacency.row(cell)[static_cast<std::size_t>(face)];
            if (neighbour == cell)
                continue;
            faces.push_back({cell, static_cast<std::uint32_t>(face)});
            faces.push_back({neighbour, static_cast<std::uint32_t>(matching_face_in(mesh, adjacency, cell, face))});
        }
    }
    return faces;
}

void separate(Adjacency& adjacency, const std::vector<CellFace>& faces)
{
    for (const CellFace& face : faces) {
        adjacency.neighbour[std::size_t{face.cell} * static_cast<std::size_t>(adjacency.row_length) + face.face] =
            face.cell;
        adjacency.interior[face.cell] &= static_cast<std::uint8_t>(~(1u << face.face));
    }
}

Adjacency adjacency_of_solids(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    Adjacency adjacency =
        scene.is_tetrahedral()
            ? adjacency_by(scene, 4,
                           [&](CellId cell, int face) {
                               return tetrahedron_face_key(mesh.vertices.data() + mesh.offsets[cell], face);
                           })
            : adjacency_by(scene, 6, [&](CellId cell, int face) { return face_key(mesh, cell, face, 3); });
    adjacency.folded = find_folded(scene, adjacency);
    const std::vector<CellFace> of_flats = faces_of_stray_flats(scene, adjacency);
    separate(adjacency, adjacency.folded);
    separate(adjacency, of_flats);
    return adjacency;
}

} // namespace

Adjacency derive_adjacency(const Scene& scene)
{
    if (!scene.is_surface())
        return adjacency_of_solids(scene);
    return adjacency_by(scene, 3, [&](CellId cell, int face) { return face_key(scene.mesh(), cell, face, 2); });
}

int matching_face(const Scene& scene, CellId cell, int face)
{
    return matching_face_in(scene.mesh(), scene.adjacency(), cell, face);
}

} // namespace visorder::detail
