#include "checking/audit_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace visorder::detail {

namespace {

// Numbers of one ray, whatever thread it is made on (Steele, Lea and Flood 2014, SplitMix).
class RayNumbers {
public:
    RayNumbers(std::uint64_t seed, std::uint64_t ray) : state_(seed * 0x9e3779b97f4a7c15u + ray * 0xd1342543de82ef95u)
    {
    }

    std::uint64_t next()
    {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    // In [0, 1).
    double real() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    std::size_t below(std::size_t count) { return next() % count; }

private:
    std::uint64_t state_;
};

struct Sampler {
    const RayTracer& tracer;
    RayNumbers numbers;

    const Mesh& mesh() const { return tracer.scene().mesh(); }

    CellId any_cell() { return static_cast<CellId>(numbers.below(tracer.scene().cell_count())); }

    glm::dvec3 in_box()
    {
        const Box& box = tracer.scene().bounds();
        glm::dvec3 p;
        for (int c = 0; c < 3; ++c) {
            const double t = numbers.real();
            p[c] = (1 - t) * box.min[c] + t * box.max[c];
        }
        return p;
    }

    glm::dvec3 in_cell(CellId cell)
    {
        std::array<double, max_cell_vertices> weights{};
        double sum = 0;
        const auto v = mesh().cell(cell);
        for (std::size_t i = 0; i < v.size(); ++i)
            sum += weights[i] = numbers.real() + 1e-3;
        glm::dvec3 p(0);
        for (std::size_t i = 0; i < v.size(); ++i)
            p += weights[i] / sum * mesh().points[v[i]];
        return p;
    }

    // The direction of the ray through a point, times anything.
    glm::dvec3 direction_at(const glm::dvec3& p) const { return p * tracer.eye().w - glm::dvec3(tracer.eye()); }

    // Where the edge from a to b meets the plane of the eye and the edge from c to d: the fraction of the way.
    double crossing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) const
    {
        const glm::dvec3 n = glm::cross(direction_at(c), d - c);
        const double at_a = glm::dot(n, a - c), at_b = glm::dot(n, b - c);
        return at_a / (at_a - at_b);
    }

    // Points of one cell's edges that the eye sees on an edge of the other. Not all pairs of vertices of a cell are
    // edges, but the lines between them are in its image all the same.
    std::vector<glm::dvec3> crossings(CellId one, CellId other) const
    {
        std::vector<glm::dvec3> points;
        const auto v = mesh().cell(one), u = mesh().cell(other);
        for (std::size_t i = 0; i < v.size(); ++i)
            for (std::size_t j = i + 1; j < v.size(); ++j)
                for (std::size_t k = 0; k < u.size(); ++k)
                    for (std::size_t l = k + 1; l < u.size(); ++l) {
                        const glm::dvec3 &a = mesh().points[v[i]], &b = mesh().points[v[j]], &c = mesh().points[u[k]],
                                         &d = mesh().points[u[l]];
                        const double t = crossing(a, b, c, d), s = crossing(c, d, a, b);
                        if (t > 0 && t < 1 && s > 0 && s < 1)
                            points.push_back((1 - t) * a + t * b);
                    }
        return points;
    }

    // Two cells whose images overlap: one by lot, and one on a ray through near its edge; twice the same where there is
    // none.
    std::pair<CellId, CellId> two_cells()
    {
        const CellId one = any_cell();
        const auto v = mesh().cell(one);
        const std::size_t i = numbers.below(v.size()), j = numbers.below(v.size());
        const double t = numbers.real();
        glm::dvec3 p = (1 - t) * mesh().points[v[i]] + t * mesh().points[v[j]];
        p = 0.99 * p + 0.01 * in_cell(one);
        RaySequence along;
        tracer.trace(p, along);
        const CellId other = along.cells.empty() ? one : along.cells[numbers.below(along.cells.size())];
        return {one, other};
    }

    // The mean of points in an image, as a point at the depth of the first.
    glm::dvec3 mean_in_image(const std::vector<glm::dvec3>& points) const
    {
        const glm::dvec3 first = points.front(), forward = direction_at(first);
        glm::dvec3 sum(0);
        for (const glm::dvec3& p : points) {
            const glm::dvec3 d = direction_at(p);
            sum += p - glm::dot(p - first, forward) / glm::dot(d, forward) * d;
        }
        return sum / static_cast<double>(points.size());
    }

    glm::dvec3 beside(const glm::dvec3& p, CellId cell)
    {
        glm::dvec3 size(0);
        for (PointId v : mesh().cell(cell))
            size = glm::max(size, glm::abs(mesh().points[v] - p));
        const double least = std::max({size.x, size.y, size.z}) * std::pow(10.0, -12 * numbers.real());
        glm::dvec3 aside;
        for (int c = 0; c < 3; ++c)
            aside[c] = least * (2 * numbers.real() - 1);
        return p + aside;
    }
};

bool is_finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

} // namespace

glm::dvec3 audit_point(const RayTracer& tracer, std::uint64_t seed, std::uint64_t number)
{
    Sampler sampler{tracer, {seed, number}};
    if (number % 4 == 0)
        return sampler.in_box();
    if (number % 4 == 1)
        return sampler.in_cell(sampler.any_cell());
    const auto [one, other] = sampler.two_cells();
    std::vector<glm::dvec3> points;
    if (one != other)
        points = sampler.crossings(one, other);
    std::erase_if(points, [](const glm::dvec3& p) { return !is_finite(p); });
    if (points.empty())
        return sampler.in_cell(one);
    const glm::dvec3 p = number % 4 == 2 ? sampler.mean_in_image(points)
                                         : sampler.beside(points[sampler.numbers.below(points.size())], one);
    return is_finite(p) ? p : sampler.in_cell(one);
}

} // namespace visorder::detail
