#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "tests/checking/brute_force.h"
#include "tests/checking/small_scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <sstream>

namespace visorder::tests {

using namespace detail;
namespace {

using Face = std::vector<glm::dvec3>;

const glm::dvec4 from_above(0, 0, 1, 0);
const glm::dvec4 from_a_point_above(0.5, 0.25, 100, 1);

Overlap mirrored(Overlap overlap)
{
    return overlap == Overlap::nearer ? Overlap::farther : overlap == Overlap::farther ? Overlap::nearer : overlap;
}

// In both orders, from the point with every weight, and with every vertex of each face first.
void expect_overlap(Overlap expected, const Face& f, const Face& g, const glm::dvec4& eye)
{
    std::vector<glm::dvec4> eyes{eye};
    if (eye.w != 0)
        for (double weight : {-1.0, 4.0, 3.0, -0.1})
            eyes.push_back(eye * weight);
    else
        eyes.push_back(eye * 1e100);
    for (std::size_t turn = 0; turn < f.size(); ++turn)
        for (const glm::dvec4& e : eyes) {
            // Thirds and tenths of a position are other positions; exact multiples only.
            if (eye.w != 0 && glm::dvec3(e) / e.w != glm::dvec3(eye))
                continue;
            Face turned = f;
            std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
            EXPECT_EQ(face_overlap(turned, g, e), expected);
            EXPECT_EQ(face_overlap(g, turned, e), mirrored(expected));
            std::reverse(turned.begin(), turned.end());
            EXPECT_EQ(face_overlap(turned, g, e), expected);
        }
}

const Face triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

TEST(FaceOverlap, FacesThatTouchInProjectionShareNoArea)
{
    for (const glm::dvec4& eye : {from_above, from_a_point_above}) {
        expect_overlap(Overlap::disjoint, triangle, {{4, 0, 0}, {0, 4, 0}, {4, 4, 0}}, eye);  // along an edge
        expect_overlap(Overlap::disjoint, triangle, {{1, 3, 0}, {2, 2, 0}, {4, 4, 0}}, eye);  // along part of one
        expect_overlap(Overlap::disjoint, triangle, {{4, 0, 0}, {8, 0, 5}, {4, -3, 0}}, eye); // at a vertex
        expect_overlap(Overlap::disjoint, triangle, {{2, 2, 0}, {8, 0, 5}, {8, 8, -2}}, eye); // vertex on an edge
        expect_overlap(Overlap::disjoint, triangle, {{10, 0, 1}, {14, 0, 1}, {10, 4, 1}}, eye);
    }
    // Touching only as seen along the direction.
    expect_overlap(Overlap::disjoint, triangle, {{4, 0, 7}, {0, 4, -3}, {4, 4, 2}}, from_above);
}

TEST(FaceOverlap, TheFaceAboveIsNearerFromAbove)
{
    for (const glm::dvec4& eye : {from_above, from_a_point_above}) {
        expect_overlap(Overlap::nearer, {{1, 1, 1}, {2, 1, 1}, {1, 2, 2}}, triangle, eye);       // inside
        expect_overlap(Overlap::nearer, {{-9, -9, 1}, {29, -9, 1}, {-9, 29, 2}}, triangle, eye); // around
        expect_overlap(Overlap::nearer, {{1, 1, 1}, {20, 1, 1}, {1, 20, 2}}, triangle, eye);
        expect_overlap(Overlap::nearer, {{0, 0, 0}, {4, 0, 0}, {0, 4, 3}}, triangle, eye); // folded at a common edge
        expect_overlap(Overlap::nearer, {{1, 1, 0}, {5, 1, 0}, {1, 5, 3}, {0.5, 3, 3}}, triangle, eye); // touching
    }
    // Planes that cross, but beside the common rays.
    expect_overlap(Overlap::nearer, {{-1, -1, 9}, {9, -1, -1}, {-1, 9, 9}}, {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}},
                   from_above);
}

TEST(FaceOverlap, FacesInOnePlaneCoincideWhereTheyShareArea)
{
    for (const glm::dvec4& eye : {from_above, from_a_point_above}) {
        expect_overlap(Overlap::coincident, triangle, triangle, eye);
        expect_overlap(Overlap::coincident, triangle, {{1, 1, 0}, {5, 1, 0}, {5, 5, 0}, {1, 5, 0}}, eye);
        expect_overlap(Overlap::coincident, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                       {{-1, 1, 0}, {5, 1, 0}, {5, 2, 0}, {-1, 2, 0}}, eye);
    }
}

TEST(FaceOverlap, FacesThatPierceEachOtherCross)
{
    for (const glm::dvec4& eye : {from_above, from_a_point_above}) {
        expect_overlap(Overlap::crossing, {{1, 1, -1}, {2, 1, 1}, {1, 2, 1}}, triangle, eye);
        // Corners of both outside of the other: the crossings of edges tell.
        expect_overlap(Overlap::crossing, {{-1, -5, -9}, {1, -5, 9}, {1, 5, 9}, {-1, 5, -9}},
                       {{-5, -1, 0}, {5, -1, 0}, {5, 1, 0}, {-5, 1, 0}}, eye);
    }
}

TEST(FaceOverlap, FacesBehindTheEyeAreNotInFrontOfIt)
{
    const glm::dvec4 eye(0.1, 0.2, 0.3, 1);
    const Face above{{-3, -3, 5}, {3, -3, 5}, {0, 3, 5}};
    Face below = above;
    for (glm::dvec3& p : below)
        p = 2.0 * glm::dvec3(eye) - p;
    expect_overlap(Overlap::disjoint, above, below, eye);
    for (glm::dvec3& p : below)
        p.z -= 100;
    expect_overlap(Overlap::disjoint, above, below, eye);
    // So wide that every plane through an edge of one cuts the other.
    expect_overlap(Overlap::disjoint, {{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}}, {{-9, 8, -1}, {9, 8, -1}, {0, -9, -1}},
                   eye);
}

TEST(FaceOverlap, ConesThatOnlyAPlaneThroughACornerOfEachSeparates)
{
    // The second triangle is the first, turned by half a turn, from above the eye to below it, and a little raised.
    // Then in directions the first and the opposite of the second are a hexagram: each edge of one cuts off a corner of
    // the other, so no edge's plane separates the cones.
    const glm::dvec4 eye(0, 0, 0, 1);
    const Face f{{0, 20, 1}, {-17, -10, 1}, {17, -10, 1}};
    for (double lift : {0.0, 1.0, 3.0, 6.0}) {
        const Face g{{0, 20, -1 + 0.01 * lift}, {-17, -10, -1}, {17, -10, -1}};
        expect_overlap(Overlap::disjoint, f, g, eye);
    }
    expect_overlap(Overlap::disjoint, f, {{0, 20, 0.9}, {-17, -10, -1}, {17, -10, -1}}, glm::dvec4(0, 0, 0.95, 1));
}

TEST(FaceOverlap, RepeatedAndCollinearVerticesDoNotMatter)
{
    for (const glm::dvec4& eye : {from_above, from_a_point_above}) {
        const Face above{{1, 1, 1}, {1, 1, 1}, {3, 1, 1}, {1, 3, 1}};
        expect_overlap(Overlap::nearer, above, triangle, eye);
        expect_overlap(Overlap::disjoint, above, {{9, 9, 0}, {9, 9, 0}, {8, 9, 0}, {8, 8, 0}}, eye);
        expect_overlap(Overlap::nearer, {{1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {1, 3, 1}}, triangle, eye);
        expect_overlap(Overlap::disjoint, {{-4, 0, 0}, {-4, 2, 0}, {-4, 4, 0}, {0, 0, 0}}, triangle, eye);
    }
}

TEST(FaceOverlap, EdgeOnFacesOverlapNothing)
{
    expect_overlap(Overlap::disjoint, triangle, {{1, 1, -1}, {2, 1, -1}, {1, 1, 1}}, from_above);
    expect_overlap(Overlap::disjoint, triangle, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, from_above);
    expect_overlap(Overlap::disjoint, triangle, {{1, 1, 1}, {1, 1, 1}, {3, 3, 3}}, from_above);
}

TEST(FaceOverlap, OneUlpDecides)
{
    const double up = std::nextafter(1.0, 2.0), down = std::nextafter(1.0, 0.0);
    const auto raised = [](double z) { return Face{{0.1, 0.1, z}, {0.7, 0.1, z}, {0.1, 0.6, z}}; };
    for (const glm::dvec4& eye : {from_above, glm::dvec4(0.3, 0.2, 1e9, 1), glm::dvec4(0.2, 0.2, 1.5, 1)}) {
        expect_overlap(Overlap::nearer, raised(up), raised(1), eye);
        expect_overlap(Overlap::farther, raised(down), raised(1), eye);
        expect_overlap(Overlap::coincident, raised(1), raised(1), eye);
        expect_overlap(Overlap::crossing, {{0.1, 0.1, up}, {0.7, 0.1, 1}, {0.1, 0.6, down}}, raised(1), eye);
    }
    const auto beside = [](double x) { return Face{{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}}; };
    expect_overlap(Overlap::disjoint, beside(0), beside(1), from_above);
    expect_overlap(Overlap::coincident, beside(0), beside(down), from_above);
}

// The relation from the definition: the cones' common rays from their facets, each ray's order from the linear function
// that is the difference of the two inverse depths (or, along a direction, depths).
class Definition {
public:
    Definition(const Face& f, const Face& g, const glm::dvec4& eye) : f_(cone(f, eye)), g_(cone(g, eye)) {}

    Overlap overlap() const
    {
        std::vector<Vector3> facets = f_.facets;
        facets.insert(facets.end(), g_.facets.begin(), g_.facets.end());
        const auto inside = [&](const Vector3& x, int least) {
            return std::all_of(facets.begin(), facets.end(),
                               [&](const Vector3& n) { return CGAL::sign(brute_force::dot(n, x)) >= least; });
        };
        std::vector<Vector3> rays;
        for (const Vector3& a : facets)
            for (const Vector3& b : facets)
                if (const Vector3 x = brute_force::cross(a, b); !brute_force::all_zero(x) && inside(x, 0))
                    rays.push_back(x);
        Vector3 middle{};
        for (const Vector3& x : rays)
            middle = brute_force::sum(middle, x);
        if (rays.empty() || !inside(middle, 1))
            return Overlap::disjoint;
        bool nearer = false, farther = false;
        for (const Vector3& x : rays) {
            const int s = CGAL::sign(brute_force::dot(f_.value, x) * g_.determinant -
                                     brute_force::dot(g_.value, x) * f_.determinant);
            nearer |= s > 0;
            farther |= s < 0;
        }
        return nearer && farther ? Overlap::crossing
               : nearer          ? Overlap::nearer
               : farther         ? Overlap::farther
                                 : Overlap::coincident;
    }

private:
    using Number = brute_force::Number;
    using Vector3 = brute_force::Vector3;

    struct Cone {
        std::vector<Vector3> facets; // inward normals
        Vector3 value;               // over determinant > 0: greater is nearer
        Number determinant;
    };

    static Cone cone(const Face& face, const glm::dvec4& eye)
    {
        std::vector<Vector3> rays;
        std::vector<Number> values;
        const glm::dvec3 direction(eye);
        const glm::dvec3 across =
            direction.x != 0 || direction.y != 0 ? glm::dvec3(-direction.y, direction.x, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 along(direction.y * across.z - direction.z * across.y,
                               direction.z * across.x - direction.x * across.z,
                               direction.x * across.y - direction.y * across.x);
        for (const glm::dvec3& p : face) {
            const auto x = brute_force::exact(p);
            if (eye.w == 0) {
                rays.push_back({brute_force::dot(brute_force::exact(across), x),
                                brute_force::dot(brute_force::exact(along), x), Number(1)});
                values.push_back(brute_force::dot(brute_force::exact(direction), x));
            } else {
                rays.push_back(brute_force::sum(x, brute_force::negated(brute_force::exact(direction))));
                values.emplace_back(1);
            }
        }
        Cone result;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            Vector3 n = brute_force::cross(rays[i], rays[(i + 1) % rays.size()]);
            if (brute_force::dot(n, rays[(i + 2) % rays.size()]) < 0)
                n = brute_force::negated(n);
            result.facets.push_back(n);
        }
        const Vector3 yz = brute_force::cross(rays[1], rays[2]), zx = brute_force::cross(rays[2], rays[0]),
                      xy = brute_force::cross(rays[0], rays[1]);
        result.determinant = brute_force::dot(rays[0], yz);
        for (std::size_t c = 0; c < 3; ++c)
            result.value[c] = values[0] * yz[c] + values[1] * zx[c] + values[2] * xy[c];
        if (result.determinant < 0) {
            result.determinant = -result.determinant;
            result.value = brute_force::negated(result.value);
        }
        return result;
    }

    Cone f_, g_;
};

Face random_face(Random& random, int low, int high)
{
    const glm::dvec3 a = random.integer_point(low, high), b = random.integer_point(low, high),
                     c = random.integer_point(low, high);
    return random.below(2) == 0 ? Face{a, b, c} : Face{a, b, b + c - a, c};
}

TEST(FaceOverlap, AgreesWithTheDefinitionOnRandomFaces)
{
    Random random(7);
    std::array<int, 5> seen{};
    for (int i = 0; i < 40000; ++i) {
        const int size = random.from_to(1, 6);
        const bool around = random.below(2) == 0; // the eye among the faces
        const int low = around ? -size : 1;
        const glm::dvec4 eye = random.below(3) != 0
                                   ? glm::dvec4(around ? glm::dvec3(0) : random.integer_point(-size, 0), 1)
                                   : glm::dvec4(random.integer_point(-2, 2), 0);
        if (eye == glm::dvec4(0))
            continue;
        const Face f = random_face(random, low, size), g = random_face(random, low, size);
        if (side_of_plane(f[0], f[1], f[2], eye) == Sign::zero || side_of_plane(g[0], g[1], g[2], eye) == Sign::zero)
            continue;
        std::ostringstream pair;
        for (const Face& face : {f, g})
            for (const glm::dvec3& p : face)
                pair << (&p == face.data() ? "\n" : " ") << p.x << ',' << p.y << ',' << p.z;
        pair << "\nfrom " << eye.x << ',' << eye.y << ',' << eye.z << ',' << eye.w;
        const Overlap overlap = face_overlap(f, g, eye);
        ASSERT_EQ(overlap, Definition(f, g, eye).overlap()) << pair.str();
        ASSERT_EQ(face_overlap(g, f, eye), mirrored(overlap)) << pair.str();
        ++seen[static_cast<std::size_t>(overlap)];
    }
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int count) { return count > 100; }));
}

TEST(FaceOverlap, TheCommonPointLiesWithinBothShadows)
{
    Random random(11);
    int checked = 0;
    for (int i = 0; i < 4000; ++i) {
        const Face f = random_face(random, 0, 6), g = random_face(random, 0, 6);
        const glm::dvec4 eye =
            i % 2 == 0 ? glm::dvec4(random.integer_point(-9, 9), 1) : glm::dvec4(random.integer_point(1, 3), 0);
        const SeenFace seen_f = seen_face(f, eye), seen_g = seen_face(g, eye);
        if (face_overlap(seen_f, seen_g, eye) == Overlap::disjoint)
            continue;
        const glm::dvec3 x = common_point(seen_f, seen_g, eye);
        // A small face of its own, across the ray, overlaps both; rounding is far below its size.
        const auto inside = [&](const SeenFace& face) {
            for (int k = 0; k < face.count; ++k) {
                const glm::dvec3 &a = face.points[static_cast<std::size_t>(k)],
                                 &b = face.points[static_cast<std::size_t>((k + 1) % face.count)];
                if (side_of_plane(a, b, x, eye) != face.turn)
                    return false;
            }
            return true;
        };
        EXPECT_TRUE(inside(seen_f));
        EXPECT_TRUE(inside(seen_g));
        ++checked;
    }
    EXPECT_GT(checked, 500);
}

} // namespace
} // namespace visorder::tests
