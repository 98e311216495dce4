#include "bsp/bsp_xmpvo.h"
#include "bsp/corner_heights.h"
#include "bsp/face_corners.h"
#include "bsp/face_images.h"
#include "bsp/touching_faces.h"
#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/seen_face.h"

#include "geometry/face_overlap.h"
#include "scene/face_loop.h"
#include "scene/face_planes.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"
#include "tests/checking/small_scenes.h"
#include "visorder/checking.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

// What the quick tests say of two faces is held against the exact one.
namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

struct Answers {
    std::size_t pairs = 0;
    std::size_t sides_known = 0;
    std::size_t areas_known = 0;
    std::size_t with_images = 0; // pairs
    std::size_t at_corners = 0;  // of these, with one corner in common
    std::size_t corners_known = 0;
    std::size_t sides_of_shared = 0; // of what they share, known
    std::size_t touching = 0;        // pairs
    std::size_t covering = 0;        // of these, known to
};

class QuickTests {
public:
    explicit QuickTests(const Scene& scene)
        : scene_(scene),
          faces_(faces_of(scene)),
          has_area_(with_area()),
          corners_(scene.mesh(), faces_, has_area_),
          heights_(scene, faces_, corners_),
          touching_(corners_, heights_, [this](std::uint32_t f, std::uint32_t g) { return heights_.nearer(f, g); }),
          images_(corners_)
    {
    }

    void expect_right_answers(const glm::dvec4& eye, Answers& answers)
    {
        const ProjectionCharts charts(scene_.bounds(), eye);
        if (charts.has_images())
            images_.project(charts);
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            for (std::uint32_t g = 0; g < faces_.size(); ++g)
                if (f != g && has_area_[f] != 0 && has_area_[g] != 0 && has_side(f, Sign::negative, eye) &&
                    has_side(g, Sign::positive, eye))
                    expect_right_answer(f, g, eye, charts.has_images(), answers);
    }

private:
    static std::vector<CellFace> faces_of(const Scene& scene)
    {
        if (!scene.is_surface())
            return scene.boundary().faces;
        std::vector<CellFace> faces;
        for (CellId cell = 0; cell < scene.cell_count(); ++cell)
            faces.push_back({cell, 0});
        return faces;
    }
    std::vector<std::uint8_t> with_area() const
    {
        std::vector<std::uint8_t> has_area;
        for (const CellFace& face : faces_) {
            const FaceLoop loop = boundary_loop(scene_.mesh(), face);
            has_area.push_back(loop.count >= 3 && spanning_triple(scene_.mesh(), loop));
        }
        return has_area;
    }
    bool has_side(std::uint32_t face, Sign side, const glm::dvec4& eye) const
    {
        if (scene_.is_surface())
            return corners_.seen(face, eye).turn != Sign::zero;
        return exact_face_side(scene_, faces_[face].cell, static_cast<int>(faces_[face].face), eye) == side;
    }

    void expect_right_answer(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye, bool has_images, Answers& answers)
    {
        SCOPED_TRACE(fmt::format("faces {} and {}", f, g));
        const Overlap overlap =
            face_overlap(seen_face(scene_.mesh(), faces_[f], eye), seen_face(scene_.mesh(), faces_[g], eye), eye);
        EXPECT_EQ(face_overlap(corners_.seen(f, eye), corners_.seen(g, eye), eye), overlap);
        ++answers.pairs;
        const Sure nearer = heights_.nearer(f, g);
        answers.sides_known += nearer != Sure::unknown;
        if (nearer == Sure::no) {
            EXPECT_TRUE(overlap == Overlap::disjoint || overlap == Overlap::farther);
        }
        if (nearer == Sure::yes) {
            EXPECT_TRUE(overlap == Overlap::disjoint || overlap == Overlap::nearer);
        }
        expect_right_touching(f, g, overlap, nearer, answers);
        if (!has_images)
            return;
        ++answers.with_images;
        const Shared shared = images_.shared(f, g);
        answers.areas_known += shared != Shared::unknown;
        if (shared != Shared::unknown) {
            EXPECT_EQ(shared == Shared::nothing, overlap == Overlap::disjoint);
        }
        if (overlap != Overlap::disjoint) {
            EXPECT_TRUE(meet(images_.box(f), images_.box(g)));
        }
        if (const TouchingFaces::Touching* pair = find_touching(f, g); pair != nullptr && pair->at_one_corner)
            expect_right_angle(f, *pair, overlap, answers);
    }

    const TouchingFaces::Touching* find_touching(std::uint32_t f, std::uint32_t g) const
    {
        for (const TouchingFaces::Touching& pair : touching_.of(f))
            if (pair.face == g)
                return &pair;
        return nullptr;
    }

    void expect_right_touching(std::uint32_t f, std::uint32_t g, Overlap overlap, Sure nearer, Answers& answers) const
    {
        const FaceCorners::Corners &of_f = corners_.of(f), &of_g = corners_.of(g);
        const unsigned common = FaceCorners::common(of_f, of_g).of_first;
        const TouchingFaces::Touching* const pair = find_touching(f, g);
        EXPECT_EQ(touching_.holds(f, g), common != 0);
        EXPECT_EQ(pair != nullptr, common != 0 && nearer != Sure::no);
        if (pair == nullptr)
            return;
        ++answers.touching;
        EXPECT_EQ(of_f[pair->at], of_g[pair->other_at]);
        std::vector<std::uint32_t> both;
        for (std::uint32_t corner : std::span(of_f).first(static_cast<std::size_t>(FaceCorners::count(of_f))))
            if (std::find(of_g.begin(), of_g.end(), corner) != of_g.end())
                both.push_back(corner);
        EXPECT_EQ(pair->at_one_corner, both.size() == 1);
        EXPECT_EQ(pair->known == TouchingFaces::Known::nearer, nearer == Sure::yes && !covers(*pair));
        if (covers(*pair)) {
            ++answers.covering;
            EXPECT_EQ(overlap, Overlap::nearer);
        }
    }

    static bool covers(const TouchingFaces::Touching& pair) { return pair.known == TouchingFaces::Known::covers; }

    void expect_right_angle(std::uint32_t f, const TouchingFaces::Touching& pair, Overlap overlap,
                            Answers& answers) const
    {
        ++answers.at_corners;
        const auto [shared, sides] = images_.shared_at(f, pair.at, pair.face, pair.other_at);
        answers.corners_known += shared != Shared::unknown;
        if (shared != Shared::unknown) {
            EXPECT_EQ(shared == Shared::nothing, overlap == Overlap::disjoint);
        }
        if (sides == 0)
            return;
        ++answers.sides_of_shared;
        EXPECT_EQ(shared, Shared::area);
        EXPECT_EQ(std::popcount(sides), 2);
        if ((sides & ~unsigned{pair.outside}) == 0) {
            EXPECT_EQ(overlap, Overlap::nearer);
        }
        if ((sides & ~unsigned{pair.inside}) == 0) {
            EXPECT_EQ(overlap, Overlap::farther);
        }
    }

    static bool meet(const Box& a, const Box& b)
    {
        return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
    }

    const Scene& scene_;
    std::vector<CellFace> faces_;
    std::vector<std::uint8_t> has_area_;
    FaceCorners corners_;
    CornerHeights heights_;
    TouchingFaces touching_;
    FaceImages images_;
};

std::vector<glm::dvec4> eyes_around(const Scene& scene, std::uint64_t seed)
{
    std::vector<glm::dvec4> eyes = some_of(small_scene_eyes(scene, seed), seed, 4);
    Random random(seed);
    const glm::dvec3 size = scene.bounds().max - scene.bounds().min;
    for (int i = 0; i < 4; ++i) {
        const double x = random.real() - 0.5, y = random.real() - 0.5, z = random.real() - 0.5;
        const double weight = i % 2 == 0 ? 1 : -0.3;
        eyes.emplace_back((scene.bounds().middle() + 5.0 * glm::dvec3(x, y, z) * size) * weight, weight);
        eyes.emplace_back(x, y, z, 0);
    }
    return eyes;
}

TEST(QuickTests, AreRightInSmallScenes)
{
    Answers answers;
    for (std::uint64_t seed = 1; seed <= 60 && !testing::Test::HasFailure(); ++seed) {
        const Scene scene(small_scene(seed));
        QuickTests tests(scene);
        for (const glm::dvec4& eye : eyes_around(scene, seed)) {
            SCOPED_TRACE(reproduce(fmt::format("small scene {}", seed), eye));
            tests.expect_right_answers(eye, answers);
        }
    }
    EXPECT_GT(answers.pairs, 10000u);
    // Corners at integers: many planes hold corners of other faces, and many corners lie on others' edges.
    EXPECT_GT(3 * answers.sides_known, answers.pairs);
    EXPECT_GT(2 * answers.areas_known, answers.with_images);
    EXPECT_GT(answers.touching, 1000u);
    EXPECT_GT(answers.covering, 100u);
}

TEST(QuickTests, DecideNearlyAllInGeneralPosition)
{
    for (const char* specification : {"carved:400", "gear:400", "cards:60"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        QuickTests tests(scene);
        Answers answers;
        for (const NamedView& view : random_views(scene, 4, 6, {64, 64})) {
            SCOPED_TRACE(reproduce(specification, view.view.eye));
            tests.expect_right_answers(view.view.eye, answers);
        }
        EXPECT_GT(answers.with_images, 0u);
        EXPECT_GT(20 * answers.areas_known, 19 * answers.with_images) << specification;
        if (!scene.is_surface()) {
            EXPECT_GT(2 * answers.sides_known, answers.pairs) << specification;
            EXPECT_GT(answers.covering, 0u) << specification;
        }
        EXPECT_GE(20 * answers.corners_known, 19 * answers.at_corners) << specification;
        EXPECT_GE(answers.corners_known, answers.sides_of_shared) << specification;
    }
}

TEST(QuickTests, AreRightOfScenesOfAnySizeAnywhere)
{
    for (const double scale : {1e-200, 1e-100, 1e100, 1e200, 1e305})
        for (const double shift : {0.0, 1e6}) {
            Mesh mesh = carved_delaunay(30, 60, 0.6, 5);
            for (glm::dvec3& p : mesh.points)
                p = (p + shift) * (scale > 1e300 ? scale / (60 + shift) : scale);
            const Scene scene(mesh);
            QuickTests tests(scene);
            Answers answers;
            const glm::dvec3 middle = scene.bounds().middle(), size = scene.bounds().max - scene.bounds().min;
            for (const glm::dvec4& eye :
                 {glm::dvec4(middle + 0.3 * size, 1), glm::dvec4(middle + glm::dvec3(2, 1, -3) * size, 1),
                  glm::dvec4(1, 2, -3, 0), glm::dvec4(0, 0, 1, 0)}) {
                SCOPED_TRACE(reproduce(fmt::format("times {}, moved by {}", scale, shift), eye));
                tests.expect_right_answers(eye, answers);
            }
            EXPECT_GT(answers.pairs, 0u);
        }
}

// Of the faces around a corner with too many of them, there would be too many pairs.
TEST(TouchingFaces, LeavesCrowdedCornersOut)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {0, 0, 1}};
    constexpr std::uint32_t around = 120;
    for (std::uint32_t i = 0; i < around; ++i) {
        const double a = 6.28318530717958648 * i / around;
        mesh.points.emplace_back(std::cos(a), std::sin(a), i % 2 == 0 ? 0.25 : -0.25);
    }
    for (std::uint32_t i = 0; i + 1 < around; ++i)
        mesh.add(CellShape::tetrahedron, std::array{0u, 2 + i, 3 + i, 1u});
    const Scene scene(mesh);
    const std::vector<CellFace>& faces = scene.boundary().faces;
    const FaceCorners corners(scene.mesh(), faces, std::vector<std::uint8_t>(faces.size(), 1));
    const CornerHeights heights(scene, faces, corners);
    const TouchingFaces touching(corners, heights, [](std::uint32_t, std::uint32_t) { return Sure::unknown; });
    std::size_t pairs = 0;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        pairs += touching.of(f).size();
        for (const TouchingFaces::Touching& pair : touching.of(f))
            EXPECT_TRUE(touching.holds(f, pair.face));
        for (std::uint32_t g = 0; g < faces.size(); ++g) {
            const auto of_f = touching.of(f);
            EXPECT_EQ(f != g && touching.holds(f, g),
                      std::any_of(of_f.begin(), of_f.end(), [&](const auto& pair) { return pair.face == g; }))
                << f << " and " << g;
        }
    }
    EXPECT_GT(pairs, faces.size());
    EXPECT_LT(pairs, 10 * faces.size());
    const OrderChecker checker(scene);
    BspXmpvo sorter(scene, 1);
    for (const NamedView& view : random_views(scene, 5, 6, {64, 64})) {
        SCOPED_TRACE(reproduce("fan", view.view.eye));
        expect_right_order(checker, sorter, view.view.eye);
    }
}

TEST(FaceCorners, AreDistinctAndTheFirstThreeSpanThePlane)
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene(small_scene(seed));
        const std::vector<CellFace>& faces = scene.boundary().faces;
        const std::vector<std::uint8_t> all(faces.size(), 1);
        if (std::any_of(faces.begin(), faces.end(), [&](const CellFace& face) {
                const FaceLoop loop = boundary_loop(scene.mesh(), face);
                return loop.count < 3 || !spanning_triple(scene.mesh(), loop);
            }))
            continue;
        const FaceCorners corners(scene.mesh(), faces, all);
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            const FaceCorners::Corners& of = corners.of(f);
            const auto points = corners.points();
            EXPECT_FALSE(collinear(points[of[0]], points[of[1]], points[of[2]]));
            const FaceLoop loop = boundary_loop(scene.mesh(), faces[f]);
            EXPECT_EQ(FaceCorners::count(of), loop.count);
            for (PointId v : loop)
                EXPECT_TRUE(std::any_of(of.begin(), of.end(),
                                        [&](std::uint32_t c) { return points[c] == scene.mesh().points[v]; }));
            for (std::uint32_t g = 0; g < faces.size(); ++g) {
                const FaceCorners::Common common = FaceCorners::common(of, corners.of(g));
                for (unsigned i = 0; i < 4; ++i) {
                    EXPECT_EQ(common.of_first >> i & 1u,
                              std::find(corners.of(g).begin(), corners.of(g).end(), of[i]) != corners.of(g).end());
                    EXPECT_EQ(common.of_second >> i & 1u,
                              std::find(of.begin(), of.end(), corners.of(g)[i]) != of.end());
                }
            }
        }
    }
}

} // namespace
} // namespace visorder::tests
