#include "scene/numbering.h"

#include "geometry/morton_curve.h"
#include "parallel/radix_sort.h"
#include "visorder/box.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

template <class Key>
LargeArray<std::uint32_t> order_by(std::size_t n, Key&& key)
{
    LargeArray<std::uint32_t> keys(n), numbers(n), sorted(n);
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n, 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            keys[i] = key(i);
            numbers[i] = static_cast<std::uint32_t>(i);
        }
    });
    RadixSort<std::uint32_t>().sort(keys, numbers, sorted);
    return sorted;
}

template <class T>
std::vector<T> gathered(const std::vector<T>& from, std::span<const std::uint32_t> order)
{
    std::vector<T> to(order.size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, to.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            to[i] = from[order[i]];
    });
    return to;
}

} // namespace

Numbering renumber(Mesh& mesh)
{
    Box bounds;
    for (const glm::dvec3& p : mesh.points)
        bounds.add(p);
    const MortonCurve curve(bounds);
    Numbering numbering;
    numbering.caller_points = order_by(mesh.points.size(), [&](std::size_t i) { return curve.key(mesh.points[i]); });
    numbering.caller_cells = order_by(mesh.cell_count(), [&](std::size_t i) {
        const auto vertices = mesh.cell(static_cast<CellId>(i));
        const double weight = 1.0 / static_cast<double>(vertices.size());
        glm::dvec3 sum(0);
        for (PointId v : vertices)
            sum += mesh.points[v] * weight;
        return curve.key(sum);
    });

    LargeArray<PointId> inner_points(mesh.points.size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, inner_points.size(), 4096),
                              [&](const auto& range) {
                                  for (std::size_t i = range.begin(); i < range.end(); ++i)
                                      inner_points[numbering.caller_points[i]] = static_cast<PointId>(i);
                              });
    mesh.points = gathered(mesh.points, numbering.caller_points);
    if (!mesh.scalars.empty())
        mesh.scalars = gathered(mesh.scalars, numbering.caller_points);

    Mesh inner;
    inner.shapes = gathered(mesh.shapes, numbering.caller_cells);
    inner.offsets.resize(mesh.offsets.size());
    inner.offsets[0] = 0;
    for (std::size_t i = 0; i < inner.shapes.size(); ++i)
        inner.offsets[i + 1] = inner.offsets[i] + static_cast<std::uint32_t>(vertex_count(inner.shapes[i]));
    inner.vertices.resize(mesh.vertices.size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, inner.shapes.size(), 4096),
                              [&](const auto& range) {
                                  for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                      std::uint32_t* to = inner.vertices.data() + inner.offsets[i];
                                      for (PointId v : mesh.cell(numbering.caller_cells[i]))
                                          *to++ = inner_points[v];
                                  }
                              });
    mesh.shapes = std::move(inner.shapes);
    mesh.offsets = std::move(inner.offsets);
    mesh.vertices = std::move(inner.vertices);
    return numbering;
}

} // namespace visorder::detail
