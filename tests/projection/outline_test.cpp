#include "projection/outline.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

constexpr RasterLattice lattice{256, 8192};

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

// Inside is positive, for corners in either turn.
double least_side(const Outline::Triangle& t, const glm::dvec2& p)
{
    const glm::dvec2 a(t[0]), b(t[1]), c(t[2]);
    const double turn = cross(b - a, c - a) < 0 ? -1 : 1;
    return std::min({turn * cross(b - a, p - a), turn * cross(c - b, p - b), turn * cross(a - c, p - c)});
}

struct Drawn {
    VisibleCell cell;
    std::string reproduce;
};

// Many of them slim, and some so slim that nothing but rounding gives them an area.
std::vector<Drawn> random_cells(int count)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Drawn> cells;
    while (static_cast<int>(cells.size()) < count) {
        const double slimmest = cells.size() % 4 == 0 ? -15 : -4;
        const double squeeze = std::pow(10.0, slimmest * std::abs(uniform(random)));
        const double length = cells.size() % 8 == 0 ? 400 : 20;
        const double angle = 3 * uniform(random);
        std::array<glm::dvec2, 4> p{};
        for (glm::dvec2& q : p) {
            const glm::dvec2 r(length * uniform(random), length * squeeze * uniform(random));
            q = {r.x * std::cos(angle) - r.y * std::sin(angle), r.x * std::sin(angle) + r.y * std::cos(angle)};
        }
        const Silhouette s = silhouette_of(p);
        if (s.kind == SilhouetteClass::empty)
            continue;
        Drawn drawn{};
        drawn.cell.kind = s.kind;
        glm::dvec2 low = p[0], high = p[0];
        for (const glm::dvec2& q : p) {
            low = glm::min(low, q);
            high = glm::max(high, q);
        }
        const double steps = lattice.steps;
        drawn.cell.low = glm::ivec2(glm::floor(low * steps));
        drawn.cell.high = glm::ivec2(glm::ceil(high * steps));
        for (std::size_t i = 0; i < 4; ++i) {
            drawn.cell.at[i] = glm::dvec3(p[s.points[i]], 0);
            drawn.cell.areas[i] = s.areas[i];
            drawn.reproduce += fmt::format("({}, {}) ", p[s.points[i]].x, p[s.points[i]].y);
        }
        cells.push_back(drawn);
    }
    return cells;
}

void expect_covered_once(const VisibleCell& cell, const Outline& outline, std::mt19937& random)
{
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 40; ++i) {
        // Corners too, and points on edges.
        std::array<double, 4> shares{};
        for (double& s : shares)
            s = share(random) < 0.5 ? 0 : share(random);
        const double sum = shares[0] + shares[1] + shares[2] + shares[3];
        if (sum == 0)
            continue;
        glm::dvec2 place(0);
        for (std::size_t k = 0; k < 4; ++k)
            place += shares[k] / sum * glm::dvec2(cell.at[k].x, cell.at[k].y) * static_cast<double>(lattice.steps);
        int in = 0;
        int well_in = 0;
        for (const Outline::Triangle& triangle : outline.triangles()) {
            const double side = least_side(triangle, place);
            in += side >= -1e-6 ? 1 : 0;
            well_in += side > 1e-6 ? 1 : 0;
        }
        EXPECT_GE(in, 1) << place.x << ", " << place.y;
        EXPECT_LE(well_in, 1) << place.x << ", " << place.y;
    }
}

TEST(Outline, CoversACellOnceWhereverItIsRounded)
{
    std::mt19937 random(5);
    std::array<int, 5> triangles{};
    for (const auto& [cell, reproduce] : random_cells(5000)) {
        SCOPED_TRACE(reproduce);
        const Outline outline = outline_of(cell, lattice);
        ++triangles[outline.triangles().size()];
        expect_covered_once(cell, outline, random);
        glm::dvec2 thickest(cell.at[0].x, cell.at[0].y);
        if (cell.kind == SilhouetteClass::quad) {
            const glm::dvec2 along(cell.at[1].x - cell.at[0].x, cell.at[1].y - cell.at[0].y);
            const glm::dvec2 third(cell.at[2].x, cell.at[2].y);
            const glm::dvec2 farther = glm::dvec2(cell.at[3].x, cell.at[3].y) - third;
            thickest += cross(third - thickest, farther) / cross(along, farther) * along;
        }
        expect_covered_once(cell, fan_of(cell, thickest, lattice), random);
    }
    EXPECT_GT(triangles[1], 1000);
    EXPECT_GT(triangles[2], 100);
}

} // namespace
} // namespace visorder::tests
