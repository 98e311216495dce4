#include "bsp/pending_faces.h"

#include "tests/checking/small_scenes.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

bool meet_in_image(const Box& a, const Box& b)
{
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

// Faces by their boxes in several charts, and their ranks in a walk.
struct Faces {
    std::vector<std::vector<std::optional<Box>>> boxes; // [face][chart]
    int charts;
    std::vector<Ranks> ranks;

    std::size_t count() const { return boxes.size(); }
    static bool is_entry(std::uint32_t face) { return face % 5 != 0; }

    ImageBoxes image() const
    {
        ImageBoxes image;
        image.reset(count(), charts);
        for (std::size_t face = 0; face < count(); ++face)
            for (int chart = 0; chart < charts; ++chart)
                if (const auto& box = boxes[face][static_cast<std::size_t>(chart)])
                    image.set(face, chart, *box, ranks[face]);
                else
                    image.set_absent(face, chart);
        return image;
    }

    // Whether they meet in some chart, not all of b is nearer than a, and b comes before a in the walk, at least once.
    bool may_cover(std::uint32_t a, std::uint32_t b) const
    {
        if (ranks[b].first > ranks[a].last)
            return false;
        for (std::size_t chart = 0; chart < static_cast<std::size_t>(charts); ++chart)
            if (const auto& f = boxes[a][chart], &g = boxes[b][chart];
                f && g && meet_in_image(*f, *g) && f->min.z <= g->max.z)
                return true;
        return false;
    }
};

// Coordinates that single precision holds: multiples of 1 / 8 up to `extent`, or as few as to meet often.
Faces random_faces(Random& random, int count, int charts, int extent, int size)
{
    Faces faces{{}, charts, {}};
    const int most_rank = random.below(2) == 0 ? 5 : 0xffff;
    for (int face = 0; face < count; ++face) {
        const int rank = random.from_to(0, most_rank);
        faces.ranks.push_back(
            {static_cast<std::uint16_t>(rank), static_cast<std::uint16_t>(random.from_to(rank, most_rank))});
        auto& of_face = faces.boxes.emplace_back();
        for (int chart = 0; chart < charts; ++chart) {
            if (random.below(4) == 0) {
                of_face.emplace_back();
                continue;
            }
            // A few are as large as the image.
            const int most = random.below(20) == 0 ? 8 * extent : 8 * size;
            const glm::dvec3 low = random.integer_point(-8 * extent, 8 * extent) / 8.0;
            of_face.push_back(Box{low, low + random.integer_point(0, most) / 8.0});
        }
    }
    return faces;
}

// What a search for what `face` may cover finds; what was found before stays.
std::vector<std::uint32_t> found(PendingFaces& pending, std::uint32_t face)
{
    PendingFaces::Found found;
    pending.search(face, found);
    const std::vector<std::uint32_t> first(found.faces().begin(), found.faces().end());
    pending.search(face, found);
    EXPECT_EQ(found.faces().size(), 2 * first.size());
    EXPECT_TRUE(std::equal(first.begin(), first.end(), found.faces().begin()));
    EXPECT_TRUE(
        std::equal(first.begin(), first.end(), found.faces().begin() + static_cast<std::ptrdiff_t>(first.size())));
    return first;
}

// Each face once, ascending; expects that none was found more often than in every chart.
std::vector<std::uint32_t> distinct(std::vector<std::uint32_t> faces, int charts)
{
    std::sort(faces.begin(), faces.end());
    for (std::uint32_t face : faces)
        EXPECT_LE(std::count(faces.begin(), faces.end(), face), charts);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

// Removes and searches in random order; every search must find what one through all pending faces finds. Boxes are
// rounded to 16 bits, which may let more meet: so it must find all of `expected`, and nothing that is not pending.
void expect_found(Random& random, const Faces& faces)
{
    const ImageBoxes image = faces.image();
    PendingFaces pending;
    pending.reset(image, Faces::is_entry);
    std::vector<bool> is_pending(faces.count());
    for (std::uint32_t face = 0; face < faces.count(); ++face)
        is_pending[face] = Faces::is_entry(face);
    for (int step = 0; step < 600; ++step) {
        const auto face = static_cast<std::uint32_t>(random.below(static_cast<int>(faces.count())));
        if (random.below(8) == 0) {
            pending.remove(face);
            is_pending[face] = false;
            continue;
        }
        std::vector<std::uint32_t> expected;
        for (std::uint32_t other = 0; other < faces.count(); ++other)
            if (is_pending[other] && faces.may_cover(face, other))
                expected.push_back(other);
        const std::vector<std::uint32_t> all = found(pending, face);
        const std::vector<std::uint32_t> some = distinct(all, faces.charts);
        ASSERT_TRUE(std::includes(some.begin(), some.end(), expected.begin(), expected.end()))
            << "face " << face << " at step " << step;
        for (std::uint32_t other : some) {
            EXPECT_TRUE(is_pending[other]);
            EXPECT_LE(faces.ranks[other].first, faces.ranks[face].last);
            EXPECT_TRUE(pending.is_pending(other));
        }
    }
}

TEST(PendingFaces, AreFoundUntilTheyAreRemoved)
{
    for (std::uint64_t seed = 1; seed <= 60 && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        const int charts = seed % 3 == 0 ? 1 : 1 + random.below(6);
        expect_found(random,
                     random_faces(random, 30 + random.below(200), charts, 1 + random.below(30), 1 + random.below(4)));
    }
}

// Numbers of 16 bits hold these coordinates so well that all that do not meet are told apart.
TEST(PendingFaces, AreNotFoundWhereBoxesAreApart)
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        Faces faces = random_faces(random, 200, 1, 20, 2);
        const ImageBoxes image = faces.image();
        PendingFaces pending;
        pending.reset(image, Faces::is_entry);
        for (std::uint32_t face = 0; face < faces.count(); ++face)
            for (std::uint32_t other : found(pending, face)) {
                Box a = *faces.boxes[face][0], b = *faces.boxes[other][0];
                EXPECT_TRUE(meet_in_image({a.min - 0.01, a.max + 0.01}, b) && a.min.z <= b.max.z + 0.1)
                    << face << " and " << other;
            }
    }
}

TEST(PendingFaces, AreFoundInImagesOfAnyExtent)
{
    const double most = std::numeric_limits<double>::max();
    for (const double scale : {1e-300, 1e-40, 1e-30, 1e30, 1e37, 1e200, 1e305}) {
        SCOPED_TRACE(testing::Message() << "times " << scale);
        Random random(7);
        Faces faces = random_faces(random, 120, 2, 20, 2);
        Faces expected = faces;
        for (auto& of_face : faces.boxes)
            for (auto& box : of_face)
                if (box)
                    box = Box{box->min * scale, box->max * scale};
        // What single precision cannot tell apart meets as well: nothing that meets may be lost.
        const ImageBoxes image = faces.image();
        PendingFaces pending;
        pending.reset(image, [](std::uint32_t face) { return face % 2 == 0; });
        for (std::uint32_t face = 0; face < faces.count(); ++face) {
            const std::vector<std::uint32_t> some = distinct(found(pending, face), faces.charts);
            for (std::uint32_t other = 0; other < faces.count(); ++other)
                if (other % 2 == 0 && expected.may_cover(face, other)) {
                    EXPECT_TRUE(std::binary_search(some.begin(), some.end(), other)) << face << " and " << other;
                }
        }
    }
    // A whole chart, as where an eye is too near, among small faces.
    Random random(8);
    Faces faces = random_faces(random, 90, 6, 1, 1);
    for (std::size_t face = 0; face < faces.count(); face += 7)
        faces.boxes[face][face % 6] = Box{glm::dvec3(-most), glm::dvec3(most)};
    expect_found(random, faces);
    // All in a line, in a point, and none at all.
    for (auto& of_face : faces.boxes)
        for (auto& box : of_face)
            if (box)
                box->min.x = box->max.x = 3;
    expect_found(random, faces);
    for (auto& of_face : faces.boxes)
        for (auto& box : of_face)
            if (box)
                box = Box{glm::dvec3(1), glm::dvec3(1)};
    expect_found(random, faces);
    for (auto& of_face : faces.boxes)
        for (auto& box : of_face)
            box.reset();
    expect_found(random, faces);
}

TEST(PendingFaces, AreAllPendingAfterReset)
{
    Random random(3);
    const Faces faces = random_faces(random, 60, 2, 3, 3);
    const ImageBoxes image = faces.image();
    PendingFaces pending;
    std::size_t first_found = 0;
    for (int round = 0; round < 2; ++round) {
        pending.reset(image, Faces::is_entry);
        std::size_t all_found = 0;
        for (std::uint32_t face = 0; face < faces.count(); ++face)
            all_found += found(pending, face).size();
        if (round == 0)
            first_found = all_found;
        EXPECT_GT(all_found, 0u);
        EXPECT_EQ(all_found, first_found);
        for (std::uint32_t face = 0; face < faces.count(); ++face)
            pending.remove(face);
        for (std::uint32_t face = 0; face < faces.count(); ++face)
            EXPECT_TRUE(found(pending, face).empty());
    }
}

TEST(ImageBoxes, TellApartWhatCannotBeCovered)
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        const Faces faces = random_faces(random, 100, 1 + random.below(6), 6, 3);
        const ImageBoxes image = faces.image();
        for (std::uint32_t a = 0; a < faces.count(); ++a)
            for (std::uint32_t b = 0; b < faces.count(); ++b)
                EXPECT_EQ(image.may_cover(a, b), faces.may_cover(a, b)) << "faces " << a << " and " << b;
    }
}

TEST(ImageBoxes, MeetWhereTheyMeetInDoublePrecision)
{
    Random random(5);
    for (int i = 0; i < 20000; ++i) {
        // Boxes whose sides are within a few roundings of each other.
        const auto corner = [&] {
            const auto near = [&] { return 0.3 + 1e-8 * random.from_to(-3, 3) + 1e-16 * random.from_to(-3, 3); };
            return glm::dvec3(near(), near(), near());
        };
        const auto box = [&] {
            Box b;
            b.add(corner());
            b.add(corner());
            return b;
        };
        const Box a = box(), b = box();
        ImageBoxes image;
        image.reset(2, 1);
        image.set(0, 0, a, {0, 0});
        image.set(1, 0, b, {0, 0});
        EXPECT_TRUE(image.box(0, 0).present());
        if (meet_in_image(a, b) && a.min.z <= b.max.z) {
            EXPECT_TRUE(image.may_cover(0, 1));
        }
    }
}

TEST(ImageBoxes, AreAbsentWhereTheyAreSetSo)
{
    ImageBoxes image;
    image.reset(4, 3);
    for (std::size_t face = 0; face < 4; ++face)
        for (int chart = 0; chart < 3; ++chart)
            image.set_absent(face, chart);
    image.set(2, 1, Box{glm::dvec3(0), glm::dvec3(1)}, {1, 2});
    EXPECT_TRUE(image.box(2, 1).present());
    EXPECT_FALSE(image.box(2, 0).present());
    EXPECT_FALSE(image.box(1, 1).present());
    EXPECT_TRUE(image.may_cover(2, 2));
    EXPECT_FALSE(image.may_cover(2, 1));
    EXPECT_FALSE(image.may_cover(1, 2));
    EXPECT_EQ(image.chart_count(), 3);
    image.set_absent(2, 1);
    EXPECT_FALSE(image.box(2, 1).present());
}

} // namespace
} // namespace visorder::tests
