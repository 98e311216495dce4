#include "bsp/touching_faces.h"

#include <algorithm>
#include <bit>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

// The faces around each corner.
struct Around {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> faces;
};

std::span<const std::uint32_t> distinct(const FaceCorners& corners, std::uint32_t face)
{
    return std::span(corners.of(face)).first(static_cast<std::size_t>(FaceCorners::count(corners.of(face))));
}

Around around(const FaceCorners& corners)
{
    Around around{std::vector<std::uint32_t>(corners.points().size() + 1), {}};
    const auto each = [&](auto&& visit) {
        for (std::uint32_t face = 0; face < corners.face_count(); ++face)
            if (corners.has(face))
                for (const std::uint32_t corner : distinct(corners, face))
                    visit(face, corner);
    };
    each([&](std::uint32_t, std::uint32_t corner) { ++around.begin[corner]; });
    std::uint32_t end = 0;
    for (std::uint32_t& begin : around.begin)
        begin = end += begin;
    around.faces.resize(end);
    each([&](std::uint32_t face, std::uint32_t corner) { around.faces[--around.begin[corner]] = face; });
    return around;
}

bool is_edge(const FaceCorners::Corners& corners, unsigned bits)
{
    const unsigned count = static_cast<unsigned>(FaceCorners::count(corners));
    for (unsigned i = 0; i < count; ++i)
        if ((bits & ((1u << count) - 1)) == (1u << i | 1u << (i + 1) % count))
            return true;
    return false;
}

// Of bits of the corners of two faces, those of the corners next to one of each; see TouchingFaces::Touching.
unsigned beside(const FaceCorners::Corners& first, unsigned at_first, unsigned of_first,
                const FaceCorners::Corners& second, unsigned at_second, unsigned of_second)
{
    const auto next_to = [](const FaceCorners::Corners& corners, unsigned at, unsigned bits) {
        const auto count = static_cast<unsigned>(FaceCorners::count(corners));
        return (bits >> (at + 1) % count & 1u) | (bits >> (at + count - 1) % count & 1u) << 1;
    };
    return next_to(first, at_first, of_first) | next_to(second, at_second, of_second) << 2;
}

} // namespace

TouchingFaces::TouchingFaces(const FaceCorners& corners, const CornerHeights& heights,
                             const std::function<Sure(std::uint32_t f, std::uint32_t g)>& may_cover)
    : corners_(corners), crowded_(corners.face_count()), begin_(corners.face_count() + 1)
{
    const Around faces_around = around(corners);
    const auto touching = [&](std::uint32_t face, std::uint32_t other, Sure nearer) {
        const FaceCorners::Corners &of_face = corners.of(face), &of_other = corners.of(other);
        const FaceCorners::Common common = FaceCorners::common(of_face, of_other);
        // Two faces around an edge of less than half a turn: a ray that leaves through one next to the edge, into what
        // is between them, and enters a cell through the other one's plane, does so through the other.
        const bool covers = is_edge(of_face, common.of_first) && is_edge(of_other, common.of_second) &&
                            heights.face_each_other(face, other);
        const int at = std::countr_zero(common.of_first);
        const auto other_at = std::find(of_other.begin(), of_other.end(), of_face[static_cast<std::size_t>(at)]);
        const auto distinct_corners = (1u << FaceCorners::count(of_face)) - 1;
        Touching result{};
        result.face = other;
        result.at = static_cast<std::uint8_t>(at & 3);
        result.other_at = static_cast<std::uint8_t>((other_at - of_other.begin()) & 3);
        result.at_one_corner = std::popcount(common.of_first & distinct_corners) == 1;
        result.known = covers ? Known::covers : nearer == Sure::yes ? Known::nearer : Known::nothing;
        const CornerHeights::Sides of_others = heights.sides(face, other), of_own = heights.sides(other, face);
        result.outside = beside(of_face, result.at, of_own.outside, of_other, result.other_at, of_others.outside) & 15u;
        result.inside = beside(of_face, result.at, of_own.inside, of_other, result.other_at, of_others.inside) & 15u;
        return result;
    };
    std::vector<std::vector<Touching>> of_faces(corners.face_count());
    oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(of_faces.size()), [&](std::uint32_t face) {
        if (!corners.has(face))
            return;
        std::vector<std::uint32_t> others;
        for (std::size_t i = 0; i < corners.of(face).size(); ++i) {
            const std::uint32_t corner = corners.of(face)[i];
            const std::uint32_t begin = faces_around.begin[corner], end = faces_around.begin[corner + 1];
            if (end - begin > most_around)
                crowded_[face] |= static_cast<std::uint8_t>(1u << i);
            else
                others.insert(others.end(), faces_around.faces.begin() + begin, faces_around.faces.begin() + end);
        }
        std::sort(others.begin(), others.end());
        others.erase(std::unique(others.begin(), others.end()), others.end());
        for (const std::uint32_t other : others)
            if (other != face)
                if (const Sure sure = may_cover(face, other); sure != Sure::no)
                    of_faces[face].push_back(touching(face, other, sure));
    });
    for (std::size_t face = 0; face < of_faces.size(); ++face) {
        begin_[face] = static_cast<std::uint32_t>(touching_.size());
        touching_.insert(touching_.end(), of_faces[face].begin(), of_faces[face].end());
    }
    begin_.back() = static_cast<std::uint32_t>(touching_.size());
    touching_.shrink_to_fit();
}

} // namespace visorder::detail
