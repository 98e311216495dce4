#include "bsp/cover_search.h"

#include "geometry/face_overlap.h"
#include "scene/adjacency.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace visorder::detail {

namespace {

std::vector<std::uint8_t> with_area(const BspTree& tree)
{
    std::vector<std::uint8_t> has_area(tree.faces().size());
    for (std::size_t i = 0; i < has_area.size(); ++i)
        has_area[i] = tree.group_counts()[i] > 0;
    return has_area;
}

} // namespace

CoverSearch::CoverSearch(const Scene& scene, const BspTree& tree)
    : scene_(scene),
      faces_(tree.faces()),
      corners_(scene.mesh(), faces_, with_area(tree)),
      heights_(scene, faces_, corners_),
      touching_(corners_, heights_,
                [this](std::uint32_t f, std::uint32_t g) { return relate(f, g) ? heights_.nearer(f, g) : Sure::no; }),
      images_(corners_)
{
}

void CoverSearch::look_from(const glm::dvec4& eye, std::span<const std::uint8_t> roles, std::span<const Ranks> ranks)
{
    eye_ = eye;
    roles_ = roles;
    const ProjectionCharts charts(scene_.bounds(), eye);
    boxes_.reset(faces_.size(), charts.count());
    has_images_ = charts.has_images();
    if (has_images_)
        images_.project(charts);
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(faces_.size()), 2048),
        [&](const auto& range) {
            for (std::uint32_t face = range.begin(); face < range.end(); ++face)
                set_boxes(face, charts, ranks[face]);
        });
}

void CoverSearch::set_boxes(std::uint32_t face, const ProjectionCharts& charts, Ranks ranks)
{
    if (roles_[face] == 0) {
        for (int chart = 0; chart < charts.count(); ++chart)
            boxes_.set_absent(face, chart);
        return;
    }
    if (has_images_) {
        boxes_.set(face, 0, images_.box(face), ranks);
        return;
    }
    std::array<glm::dvec3, 4> points;
    const FaceCorners::Corners& corners = corners_.of(face);
    for (std::size_t k = 0; k < 4; ++k)
        points[k] = corners_.points()[corners[k]];
    const auto count = static_cast<std::size_t>(FaceCorners::count(corners));
    for (int chart = 0; chart < charts.count(); ++chart)
        if (const auto box = charts.box(std::span(points).first(count), chart))
            boxes_.set(face, chart, *box, ranks);
        else
            boxes_.set_absent(face, chart);
}

void CoverSearch::reset_pending()
{
    pending_.reset(boxes_, [&](std::uint32_t face) { return (roles_[face] & entry_role) != 0; });
}

bool CoverSearch::relate(std::uint32_t f, std::uint32_t g) const
{
    const CellId front = faces_[f].cell, back = faces_[g].cell;
    if (front == back || (!scene_.is_surface() && scene_.adjacency().joins(front, back)))
        return false;
    const auto& overlapping = scene_.overlapping_cells();
    const std::pair<CellId, CellId> pair = std::minmax(front, back);
    return !std::binary_search(overlapping.begin(), overlapping.end(), pair);
}

bool CoverSearch::covers(std::uint32_t f, std::uint32_t g, bool nearer, Tests& tests) const
{
    ++tests.all;
    const Shared shared = has_images_ ? images_.shared(f, g) : Shared::unknown;
    return shared != Shared::nothing && ((nearer && shared == Shared::area) || covers_exactly(f, g, shared, tests));
}

bool CoverSearch::covers(std::uint32_t f, const TouchingFaces::Touching& g, Tests& tests) const
{
    using Known = TouchingFaces::Known;
    if (g.known == Known::covers)
        return true;
    if (!has_images_ || !g.at_one_corner)
        return boxes_.may_cover(f, g.face) && covers(f, g.face, g.known == Known::nearer, tests);
    ++tests.all;
    const auto [shared, sides] = images_.shared_at(f, g.at, g.face, g.other_at);
    if (shared == Shared::nothing)
        return false;
    // Between the sides of what they share, the nearer one does not change.
    if (shared == Shared::area && (g.known == Known::nearer || (sides != 0 && (sides & ~g.outside) == 0)))
        return true;
    if (sides != 0 && (sides & ~g.inside) == 0)
        return false;
    return covers_exactly(f, g.face, shared, tests);
}

bool CoverSearch::covers_exactly(std::uint32_t f, std::uint32_t g, Shared shared, Tests& tests) const
{
    const SeenFace front = corners_.seen(f, eye_), back = corners_.seen(g, eye_);
    // Of a solid, CornerHeights has been asked.
    if (scene_.is_surface() && surely_not_nearer(front, back))
        return false;
    ++tests.exact;
    const Overlap overlap = shared == Shared::area ? depth_overlap(front, back, eye_) : face_overlap(front, back, eye_);
    return overlap == Overlap::nearer || (overlap == Overlap::coincident && !scene_.is_surface());
}

void CoverSearch::find(std::span<const std::uint32_t> faces, std::span<std::uint32_t> covered, Workspace& workspace)
{
    std::fill(covered.begin(), covered.end(), none);
    for (const std::uint32_t face : faces)
        boxes_.prefetch(face);
    PendingFaces::Found& all = workspace.found_;
    std::vector<std::uint32_t>& end = workspace.end_;
    all.clear();
    end.clear();
    for (const std::uint32_t face : faces) {
        pending_.search(face, all);
        end.push_back(static_cast<std::uint32_t>(all.faces().size()));
    }
    const std::span<std::uint32_t> found = all.faces();
    for (const std::uint32_t face : found)
        corners_.prefetch(face);
    // Most touch.
    std::uint32_t next = 0, count = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (; next < end[i]; ++next) {
            found[count] = found[next];
            count += touching_.holds(faces[i], found[next]) ? 0 : 1;
        }
        end[i] = count;
    }
    for (const std::uint32_t face : found.first(count))
        heights_.prefetch(face);
    next = 0;
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (; next < end[i]; ++next) {
            if (covered[i] != none)
                continue;
            // Few get through to what is read from anywhere in memory.
            if (const Sure nearer = heights_.nearer(faces[i], found[next]);
                nearer != Sure::no && covers(faces[i], found[next], nearer == Sure::yes, workspace.tests) &&
                relate(faces[i], found[next]))
                covered[i] = found[next];
        }
}

void CoverSearch::find_touching(std::vector<std::vector<Cover>>& touching, Tests& tests) const
{
    constexpr std::size_t faces_a_part = 2048;
    touching.resize((faces_.size() + faces_a_part - 1) / faces_a_part);
    std::atomic<std::size_t> all = 0, exact = 0;
    oneapi::tbb::parallel_for(std::size_t{0}, touching.size(), [&](std::size_t part) {
        std::vector<Cover>& covers_found = touching[part];
        covers_found.clear();
        Tests of_part;
        const auto end = static_cast<std::uint32_t>(std::min((part + 1) * faces_a_part, faces_.size()));
        for (auto face = static_cast<std::uint32_t>(part * faces_a_part); face < end; ++face) {
            if ((roles_[face] & exit_role) == 0)
                continue;
            for (const TouchingFaces::Touching& other : touching_.of(face))
                if ((roles_[other.face] & entry_role) != 0 && covers(face, other, of_part))
                    covers_found.push_back({face, other.face});
        }
        all += of_part.all;
        exact += of_part.exact;
    });
    tests.all += all;
    tests.exact += exact;
}

std::size_t CoverSearch::bytes() const
{
    return corners_.bytes() + heights_.bytes() + touching_.bytes() + images_.bytes() + boxes_.bytes() +
           pending_.bytes();
}

} // namespace visorder::detail
