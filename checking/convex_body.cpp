#include "checking/convex_body.h"

#include "geometry/exact_predicates.h"

#include <CGAL/Exact_rational.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace visorder::detail {

namespace {

// On which side of the plane through points i, j and k point l lies: an eye may be among them, as the last in order.
class Sides {
public:
    Sides(const ConvexBody& a, const ConvexBody& b, const glm::dvec4& eye) : eye_(eye)
    {
        for (const ConvexBody* body : {&a, &b})
            for (const glm::dvec3& p : body->points())
                points_[count_++] = p;
    }

    std::size_t eye() const { return count_; }
    std::size_t count() const { return count_ + 1; }

    // For i < j < k.
    Sign operator()(std::size_t i, std::size_t j, std::size_t k, std::size_t l) const
    {
        if (l == i || l == j || l == k)
            return Sign::zero;
        if (l == eye())
            return side_of_plane(points_[i], points_[j], points_[k], eye_);
        // Of the determinant of the four, two columns change places.
        if (k == eye())
            return -side_of_plane(points_[i], points_[j], points_[l], eye_);
        return side_of_plane(points_[i], points_[j], points_[k], points_[l]);
    }

private:
    std::array<glm::dvec3, 2 * max_cell_vertices> points_;
    std::size_t count_ = 0;
    glm::dvec4 eye_;
};

using Number = CGAL::Exact_rational;
using Row = std::array<Number, 4>; // a homogeneous point, or a plane: n x <= 0 on the side that counts

Row row_of(const glm::dvec3& p)
{
    return {Number(p.x), Number(p.y), Number(p.z), Number(1)};
}

Number dot(const Row& a, const Row& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

// The plane through three points, or the point in three planes; all zero if they do not determine one.
Row join(const Row& a, const Row& b, const Row& c)
{
    Row n;
    for (std::size_t skip = 0; skip < 4; ++skip) {
        const std::size_t x = skip == 0 ? 1 : 0, y = skip <= 1 ? 2 : 1, z = skip <= 2 ? 3 : 2;
        const Number minor = a[x] * (b[y] * c[z] - b[z] * c[y]) - a[y] * (b[x] * c[z] - b[z] * c[x]) +
                             a[z] * (b[x] * c[y] - b[y] * c[x]);
        n[skip] = skip % 2 == 0 ? minor : Number(-minor);
    }
    return n;
}

Row negated(Row row)
{
    for (Number& x : row)
        x = -x;
    return row;
}

// The half-spaces of the convex hull of points that do not all lie in one plane.
std::vector<Row> half_spaces(const std::vector<Row>& points)
{
    std::vector<Row> planes;
    std::vector<std::uint32_t> points_in; // of each plane, a bit per point
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                const Row plane = join(points[i], points[j], points[k]);
                std::uint32_t within = 0;
                bool above = false, below = false;
                for (std::size_t l = 0; l < points.size(); ++l) {
                    const auto side = CGAL::sign(dot(plane, points[l]));
                    above = above || side == CGAL::POSITIVE;
                    below = below || side == CGAL::NEGATIVE;
                    within |= side == CGAL::ZERO ? 1u << l : 0u;
                }
                if (above == below || std::find(points_in.begin(), points_in.end(), within) != points_in.end())
                    continue;
                planes.push_back(above ? negated(plane) : plane);
                points_in.push_back(within);
            }
    return planes;
}

std::vector<Row> rows_of(const ConvexBody& body)
{
    std::vector<Row> rows;
    for (const glm::dvec3& p : body.points())
        rows.push_back(row_of(p));
    return rows;
}

bool is_triangle(const ConvexBody& body)
{
    return body.count == 3;
}

Row plane_of_triangle(const ConvexBody& body)
{
    return join(row_of(body.vertices[0]), row_of(body.vertices[1]), row_of(body.vertices[2]));
}

// The mean of the corners of a bounded polyhedron, its weight 1.
Row mean_of_corners(const std::vector<Row>& planes)
{
    Row sum{0, 0, 0, 0};
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j)
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                Row corner = join(planes[i], planes[j], planes[k]);
                if (corner[3] == 0)
                    continue;
                const Number weight = corner[3];
                for (Number& x : corner)
                    x /= weight;
                if (std::none_of(planes.begin(), planes.end(),
                                 [&](const Row& plane) { return dot(plane, corner) > 0; }))
                    for (std::size_t c = 0; c < 4; ++c)
                        sum[c] += corner[c];
            }
    if (sum[3] == 0)
        throw std::logic_error("no corner is left of where a cell occludes another");
    const Number count = sum[3];
    for (Number& x : sum)
        x /= count;
    return sum;
}

} // namespace

ConvexBody body_of(const Mesh& mesh, CellId cell)
{
    ConvexBody body;
    for (PointId v : mesh.cell(cell)) {
        const glm::dvec3& p = mesh.points[v];
        const auto known = body.points();
        if (std::find(known.begin(), known.end(), p) == known.end())
            body.vertices[static_cast<std::size_t>(body.count++)] = p;
    }
    return body;
}

bool can_occlude(const Mesh& mesh, CellId cell, const glm::dvec4& eye)
{
    const ConvexBody body = body_of(mesh, cell);
    const auto p = body.points();
    if (mesh.shapes[cell] == CellShape::triangle)
        return p.size() == 3 && side_of_plane(p[0], p[1], p[2], eye) != Sign::zero;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = i + 1; j < p.size(); ++j)
            for (std::size_t k = j + 1; k < p.size(); ++k)
                for (std::size_t l = k + 1; l < p.size(); ++l)
                    if (side_of_plane(p[i], p[j], p[k], p[l]) != Sign::zero)
                        return true;
    return false;
}

bool occludes(const ConvexBody& front, const ConvexBody& back, const glm::dvec4& eye)
{
    const Sides side(front, back, eye);
    const auto of_front = static_cast<std::size_t>(front.count);
    const auto separates = [&](std::size_t i, std::size_t j, std::size_t k) {
        Sign side_of_hull = Sign::zero;
        for (std::size_t l = of_front; l < side.count(); ++l) {
            const Sign s = side(i, j, k, l);
            if (s != Sign::zero && s == -side_of_hull)
                return false;
            side_of_hull = s != Sign::zero ? s : side_of_hull;
        }
        if (side_of_hull == Sign::zero) // three points on one line
            return false;
        for (std::size_t l = 0; l < of_front; ++l)
            if (side(i, j, k, l) == side_of_hull)
                return false;
        return true;
    };
    for (std::size_t i = 0; i < side.count(); ++i)
        for (std::size_t j = i + 1; j < side.count(); ++j)
            for (std::size_t k = j + 1; k < side.count(); ++k)
                if (separates(i, j, k))
                    return false;
    return true;
}

glm::dvec3 occlusion_witness(const ConvexBody& front, const ConvexBody& back, const glm::dvec4& eye)
{
    const double side = eye.w < 0 ? -1 : 1;
    const Row from{Number(side * eye.x), Number(side * eye.y), Number(side * eye.z), Number(side * eye.w)};
    std::vector<Row> of_back = rows_of(back), of_front = rows_of(front);
    if (is_triangle(front))
        of_front.push_back(from);
    std::vector<Row> planes = half_spaces(of_front);
    if (is_triangle(front)) {
        planes.push_back(plane_of_triangle(front));
        planes.push_back(negated(planes.back()));
    }
    const std::vector<Row> planes_of_back =
        is_triangle(back) ? std::vector<Row>{plane_of_triangle(back)} : half_spaces(of_back);
    of_back.push_back(from);
    for (Row& plane : half_spaces(of_back))
        planes.push_back(std::move(plane));
    const Row inside = mean_of_corners(planes);

    // Onwards from there: the ray enters the solid by the last plane that it comes to from outside.
    Row direction;
    for (std::size_t c = 0; c < 4; ++c)
        direction[c] = inside[c] * from[3] - from[c];
    Number entry = 0;
    for (const Row& plane : planes_of_back) {
        const Number change = dot(plane, direction);
        if (change < 0 || (is_triangle(back) && change != 0))
            entry = std::max(entry, Number(-dot(plane, inside) / change));
    }
    glm::dvec3 point;
    for (int c = 0; c < 3; ++c) {
        const auto at = static_cast<std::size_t>(c);
        point[c] = CGAL::to_double(Number(inside[at] + entry * direction[at]));
    }
    return point;
}

} // namespace visorder::detail
