#include "bsp/bsp_tree.h"

#include "scene/adjacency.h"
#include "scene/face_loop.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <oneapi/tbb/concurrent_vector.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

namespace visorder::detail {

namespace {

constexpr std::size_t leaf_size = 32;
constexpr std::size_t plane_sample = 12;  // planes that are tried for a node
constexpr std::size_t face_sample = 128;  // faces they are tried on
constexpr std::size_t split_weight = 3;   // one face split counts as much as being this uneven
constexpr std::size_t worth_a_task = 512; // faces

// Mixes the bits of a number (Steele, Lea, Flood 2014: SplitMix64).
std::uint64_t mixed(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// A face, or what is left of it between planes, in unit coordinates (the scene within [-1, 1]).
struct Polygon {
    std::array<glm::dvec3, 12> points;
    int count = 0;
};

// With u = 2^-53: coordinates are within 2 u of their exact values, and a cut adds less than 8 u, so that the true
// piece of a face lies within 2^-40 of the computed one after any number of cuts that a tree can ask for.
constexpr double drift = 0x1p-40;

// The signed distance from a plane times the length of its normal, and how far the computed one may be off.
struct Height {
    glm::dvec3 normal;
    glm::dvec3 on;
    double error;

    Height(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) : normal(glm::cross(b - a, c - a)), on(a)
    {
        const auto length = [](const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
        // Each component of the normal is off by at most 16 u (|b - a| + |c - a|), of which a point within the scene,
        // at most 2 away along each axis, takes part; and it meets the drift of a point.
        error = 0x1p-45 * (length(b - a) + length(c - a)) + 4 * drift * length(normal) + 0x1p-1000;
    }

    double at(const glm::dvec3& x) const { return glm::dot(normal, x - on); }
};

struct Side {
    bool positive;
    bool negative;
};

// What a plane leaves of a polygon on its positive (or negative) side, taken a little wider than it is, so that the
// roundings of the cut lose nothing.
Polygon cut(const Polygon& polygon, const Height& height, double sign)
{
    Polygon rest;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec3& a = polygon.points[static_cast<std::size_t>(i)];
        const glm::dvec3& b = polygon.points[static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1)];
        const double at_a = sign * height.at(a) + 4 * height.error, at_b = sign * height.at(b) + 4 * height.error;
        // With no room for all corners, the whole polygon remains.
        if (rest.count + 2 > static_cast<int>(rest.points.size()))
            return polygon;
        if (at_a >= 0)
            rest.points[static_cast<std::size_t>(rest.count++)] = a;
        if ((at_a >= 0) != (at_b >= 0))
            rest.points[static_cast<std::size_t>(rest.count++)] = a + (b - a) * (at_a / (at_a - at_b));
    }
    return rest;
}

constexpr std::uint32_t whole = 0xffffffffu;

struct Piece {
    std::uint32_t face;
    std::uint32_t polygon; // what is left of it, or `whole`
};

struct BuiltNode {
    FaceTriple plane{};
    std::vector<std::uint32_t> group;
    std::unique_ptr<BuiltNode> positive;
    std::unique_ptr<BuiltNode> negative;
};

} // namespace

class BspConstruction {
public:
    BspConstruction(BspTree& tree, std::uint64_t seed) : tree_(tree), mesh_(tree.scene_.mesh()), seed_(seed)
    {
        const Box& bounds = tree.scene_.bounds();
        origin_ = bounds.middle();
        const glm::dvec3 half = glm::max(bounds.max - origin_, origin_ - bounds.min);
        int exponent = 0;
        std::frexp(std::max({half.x, half.y, half.z, std::numeric_limits<double>::min()}), &exponent);
        measurable_ = std::isfinite(half.x + half.y + half.z) && exponent > -900 && exponent < 900;
        scale_ = std::ldexp(1.0, measurable_ ? -exponent : 0);
    }

    void run()
    {
        const std::size_t count = tree_.faces_.size();
        loops_.resize(count);
        planes_.resize(count);
        std::vector<std::uint8_t> has_plane(count);
        oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            loops_[i] = boundary_loop(mesh_, tree_.faces_[i]);
            if (loops_[i].count < 3)
                return;
            if (const auto triple = spanning_triple(mesh_, loops_[i])) {
                planes_[i] = *triple;
                has_plane[i] = 1;
            }
        });
        std::vector<Piece> pieces;
        for (std::uint32_t i = 0; i < count; ++i)
            if (has_plane[i] != 0)
                pieces.push_back({i, whole});
        tree_.placed_ = pieces.size();
        tree_.group_counts_.assign(count, 0);
        if (pieces.empty())
            return;
        BuiltNode root;
        build(root, std::move(pieces), mixed(seed_));
        flatten(root, 0);
        for (std::uint32_t face : tree_.groups_)
            ++tree_.group_counts_[face];
    }

private:
    glm::dvec3 unit(PointId v) const { return (mesh_.points[v] - origin_) * scale_; }

    Height height_of(const FaceTriple& plane) const { return {unit(plane.a), unit(plane.b), unit(plane.c)}; }

    // On which sides of a plane the piece may have area; on neither if its face lies in the plane.
    Side sides_of(const Piece& piece, const FaceTriple& plane, const Height& height) const
    {
        if (measurable_) {
            double least = std::numeric_limits<double>::infinity(), most = -least;
            const auto take = [&](double h) {
                least = std::min(least, h);
                most = std::max(most, h);
            };
            if (piece.polygon == whole)
                for (PointId v : loops_[piece.face])
                    take(height.at(unit(v)));
            else
                for (int i = 0; i < polygons_[piece.polygon].count; ++i)
                    take(height.at(polygons_[piece.polygon].points[static_cast<std::size_t>(i)]));
            if (least > height.error || most < -height.error)
                return {least > height.error, most < -height.error};
        }
        Side sides{false, false};
        for (PointId v : loops_[piece.face]) {
            const Sign sign = v == plane.a || v == plane.b || v == plane.c
                                  ? Sign::zero
                                  : side_of_plane(mesh_.points[plane.a], mesh_.points[plane.b], mesh_.points[plane.c],
                                                  mesh_.points[v]);
            sides.positive = sides.positive || sign == Sign::positive;
            sides.negative = sides.negative || sign == Sign::negative;
        }
        return sides;
    }

    // A piece that a plane may cut, on one side of it.
    Piece part(const Piece& piece, const Height& height, double sign)
    {
        if (!measurable_)
            return piece;
        Polygon polygon;
        if (piece.polygon == whole)
            for (PointId v : loops_[piece.face])
                polygon.points[static_cast<std::size_t>(polygon.count++)] = unit(v);
        else
            polygon = polygons_[piece.polygon];
        const Polygon rest = cut(polygon, height, sign);
        // Nothing left for sure to the eye of doubles, but not proved by a margin: it stays as it was.
        if (rest.count == 0)
            return piece;
        return {piece.face, static_cast<std::uint32_t>(polygons_.push_back(rest) - polygons_.begin())};
    }

    // The plane of the face that splits few others and divides them evenly, by a sample of both.
    std::uint32_t choose(const std::vector<Piece>& pieces, std::uint64_t seed) const
    {
        std::uint32_t best = pieces.front().face;
        std::size_t best_score = std::numeric_limits<std::size_t>::max();
        const std::size_t planes = std::min(plane_sample, pieces.size());
        const std::size_t faces = std::min(face_sample, pieces.size());
        for (std::size_t i = 0; i < planes; ++i) {
            const std::uint32_t face = pieces[mixed(seed + i) % pieces.size()].face;
            const FaceTriple& plane = planes_[face];
            const Height height = height_of(plane);
            std::size_t splits = 0, positive = 0, negative = 0;
            for (std::size_t k = 0; k < faces; ++k) {
                const Side sides = sides_of(pieces[k * pieces.size() / faces], plane, height);
                positive += sides.positive;
                negative += sides.negative;
                splits += sides.positive && sides.negative;
            }
            const std::size_t uneven = positive > negative ? positive - negative : negative - positive;
            const std::size_t score = split_weight * splits + uneven;
            if (score < best_score) {
                best_score = score;
                best = face;
            }
        }
        return best;
    }

    void build(BuiltNode& node, std::vector<Piece> pieces, std::uint64_t seed)
    {
        const auto keep = [&] {
            for (const Piece& piece : pieces)
                node.group.push_back(piece.face);
        };
        if (pieces.size() <= leaf_size) {
            keep();
            return;
        }
        const FaceTriple plane = planes_[choose(pieces, seed)];
        const Height height = height_of(plane);
        std::vector<Piece> positive, negative;
        std::vector<std::uint32_t> in_plane;
        for (const Piece& piece : pieces) {
            const Side sides = sides_of(piece, plane, height);
            const bool split = sides.positive && sides.negative;
            if (sides.positive)
                positive.push_back(split ? part(piece, height, 1) : piece);
            if (sides.negative)
                negative.push_back(split ? part(piece, height, -1) : piece);
            if (!sides.positive && !sides.negative)
                in_plane.push_back(piece.face);
        }
        // Faces too much entangled for planes to part them remain together, and so do those of a convex surface: no
        // plane of one parts the others.
        if (std::max(positive.size(), negative.size()) > pieces.size() * 7 / 8) {
            keep();
            return;
        }
        node.plane = plane;
        node.group = std::move(in_plane);
        const bool large = pieces.size() >= worth_a_task;
        pieces = {};
        const auto build_child = [&](std::unique_ptr<BuiltNode>& child, std::vector<Piece>& of_child, std::uint64_t s) {
            if (of_child.empty())
                return;
            child = std::make_unique<BuiltNode>();
            build(*child, std::move(of_child), s);
        };
        const auto build_positive = [&] { build_child(node.positive, positive, mixed(seed ^ 0x5555555555555555u)); };
        const auto build_negative = [&] { build_child(node.negative, negative, mixed(seed ^ 0xaaaaaaaaaaaaaaaau)); };
        if (large) {
            oneapi::tbb::parallel_invoke(build_positive, build_negative);
        } else {
            build_positive();
            build_negative();
        }
    }

    std::uint32_t flatten(const BuiltNode& built, std::size_t depth)
    {
        const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
        const auto begin = static_cast<std::uint32_t>(tree_.groups_.size());
        tree_.groups_.insert(tree_.groups_.end(), built.group.begin(), built.group.end());
        const auto end = static_cast<std::uint32_t>(tree_.groups_.size());
        tree_.nodes_.push_back({begin, end, built.plane.a, built.plane.b, built.plane.c, BspTree::none, BspTree::none});
        tree_.depth_ = std::max(tree_.depth_, depth);
        if (built.positive)
            tree_.nodes_[index].positive = flatten(*built.positive, depth + 1);
        if (built.negative)
            tree_.nodes_[index].negative = flatten(*built.negative, depth + 1);
        return index;
    }

    BspTree& tree_;
    const Mesh& mesh_;
    std::uint64_t seed_;
    glm::dvec3 origin_{};
    double scale_ = 1;
    bool measurable_ = true; // whether doubles can hold unit coordinates; if not, original vertices alone decide
    std::vector<FaceLoop> loops_;
    std::vector<FaceTriple> planes_;
    oneapi::tbb::concurrent_vector<Polygon> polygons_;
};

BspTree::BspTree(const Scene& scene, std::uint64_t seed) : scene_(scene)
{
    if (scene.is_surface())
        for (CellId cell = 0; cell < scene.cell_count(); ++cell)
            faces_.push_back({cell, 0});
    else
        faces_ = scene.relation_faces();
    BspConstruction(*this, seed).run();
    frame_ = unit_frame(scene.bounds());
    planes_.reserve(nodes_.size());
    const auto& points = scene.mesh().points;
    for (const Node& node : nodes_)
        planes_.push_back(unit_plane(frame_, points[node.a], points[node.b], points[node.c]));
}

std::size_t BspTree::bytes() const
{
    return faces_.capacity() * sizeof(CellFace) + nodes_.capacity() * sizeof(Node) +
           planes_.capacity() * sizeof(UnitPlane) +
           (groups_.capacity() + group_counts_.capacity()) * sizeof(std::uint32_t);
}

} // namespace visorder::detail
