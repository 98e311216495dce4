#include "projection/opengl/surface_renderer.h"

#include "projection/opengl/surface_shaders.h"
#include "scene/stopwatch.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <string>

namespace visorder::detail {

namespace {

constexpr std::size_t stretch_triangles = 16384;
constexpr std::size_t ring_segments = 3;
constexpr GLuint triangles_binding = 1;
constexpr GLuint points_binding = 2;

const Scene& checked(const Scene& scene, const SurfaceOptions& options)
{
    if (!scene.is_surface())
        throw InputError("surfaces are of triangles, and this is a volume");
    if (!(options.opacity >= 0 && options.opacity <= 1))
        throw InputError(fmt::format("opacity {} must lie in [0, 1]", options.opacity));
    for (int k = 0; k < 3; ++k)
        if (!(options.colour[k] >= 0 && options.colour[k] <= 1))
            throw InputError(fmt::format("colour ({}, {}, {}) must lie in [0, 1]", options.colour.r, options.colour.g,
                                         options.colour.b));
    if (!options.function)
        return scene;
    const Mesh& mesh = scene.mesh();
    if (mesh.scalars.empty())
        throw InputError("the mesh has no scalars to colour it by");
    for (std::size_t i = 0; i < mesh.scalars.size(); ++i)
        if (!std::isfinite(mesh.scalars[i]))
            throw InputError(fmt::format("point {}: scalar {} is not finite", scene.caller_points()[i],
                                         static_cast<double>(mesh.scalars[i])));
    return scene;
}

Program make_program(const Context& context, bool by_scalars, bool channels_apart)
{
    const Context::Current current(context);
    const SurfaceColouring colouring = by_scalars ? SurfaceColouring::scalars : SurfaceColouring::flat;
    return {context,
            "surface",
            {{GL_VERTEX_SHADER, surface_vertex_shader(colouring)},
             {GL_FRAGMENT_SHADER, surface_fragment_shader(colouring, channels_apart)}}};
}

UploadRing make_ring(const Context& context)
{
    const Context::Current current(context);
    return {context, stretch_triangles * sizeof(SurfaceTriangle), ring_segments};
}

// As in surface_shaders.cpp.
struct ColourPoint {
    double scalar;
    std::array<float, 3> colour;
    std::uint32_t unused;
};

GlObject make_points(const Context& context, const std::optional<TransferFunction>& function)
{
    if (!function)
        return {};
    const Context::Current current(context);
    std::vector<ColourPoint> points;
    for (const OpticalPoint& p : function->points())
        points.push_back(
            {p.scalar,
             {static_cast<float>(p.colour.r), static_cast<float>(p.colour.g), static_cast<float>(p.colour.b)},
             0});
    GlObject buffer(context, GlKind::buffer);
    context.gl().NamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(points.size() * sizeof(ColourPoint)),
                                    points.data(), 0);
    context.check();
    return buffer;
}

} // namespace

SurfaceRenderer::SurfaceRenderer(const Context& context, const Scene& scene, const SurfaceOptions& options)
    : context_(&context),
      scene_(checked(scene, options)),
      options_(options),
      channels_apart_(options.channels_apart.value_or(context.is_software())),
      lattice_(raster_lattice(context)),
      image_(context, options.blending_bits, channels_apart_),
      program_(make_program(context, options.function.has_value(), channels_apart_)),
      function_(make_points(context, options.function)),
      ring_(make_ring(context))
{
    const Context::Current current(context);
    no_attributes_ = GlObject(context, GlKind::vertex_array);
    inner_cells_.resize(scene.cell_count());
    for (CellId inner = 0; inner < scene.cell_count(); ++inner)
        inner_cells_[scene.caller_cells()[inner]] = inner;
}

void SurfaceRenderer::place(const Screen& screen)
{
    const auto& points = scene_.mesh().points;
    points_.resize(points.size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            points_[i] = surface_point(screen, points[i]);
    });
}

// Writes those of a stretch of the order that are seen; returns how many.
std::size_t SurfaceRenderer::make(const SurfaceTriangles& triangles, const Order& order, std::size_t first,
                                  const UploadRing::Segment& segment)
{
    const std::size_t count = std::min(stretch_triangles, order.back_to_front.size() - first);
    const Mesh& mesh = scene_.mesh();
    made_.resize(count);
    is_seen_.resize(count);
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, 512), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const CellId cell = order.back_to_front[first + i];
            if (cell >= inner_cells_.size())
                throw InputError(fmt::format("the order lists cell {}, of {}", cell, inner_cells_.size()));
            const auto v = mesh.cell(inner_cells_[cell]);
            SurfaceTriangle& triangle = made_[i];
            is_seen_[i] = triangles.make({points_[v[0]], points_[v[1]], points_[v[2]]}, triangle) ? 1 : 0;
            for (std::size_t k = 0; k < 3; ++k)
                triangle.scalars[k] = options_.function ? mesh.scalars[v[k]] : 0;
        }
    });
    std::size_t seen = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (is_seen_[i] != 0)
            std::memcpy(segment.memory.data() + sizeof(SurfaceTriangle) * seen++, &made_[i], sizeof(SurfaceTriangle));
    return seen;
}

Image SurfaceRenderer::draw(const View& view, const Order& order)
{
    if (order.back_to_front.size() != scene_.cell_count())
        throw InputError(
            fmt::format("the order lists {} cells; the scene has {}", order.back_to_front.size(), scene_.cell_count()));
    const Context::Current current(*context_);
    const GlFunctions& gl = context_->gl();
    statistics_ = {};
    Stopwatch watch;
    const Screen screen(view, scene_.bounds());
    place(screen);
    statistics_.place_s = watch.lap();

    image_.start(screen.size(), screen.centre(), lattice_);
    program_.set("half_range", static_cast<float>(lattice_.half_range));
    program_.set("centre", glm::vec2(screen.centre()));
    program_.set("hidden", static_cast<float>(options_.opacity));
    if (options_.function)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, points_binding, function_.id());
    else
        program_.set("colour", glm::vec3(options_.colour));
    program_.use();
    gl.BindVertexArray(no_attributes_.id());
    const SurfaceTriangles triangles(screen, lattice_);
    for (std::size_t first = 0; first < order.back_to_front.size(); first += stretch_triangles) {
        const UploadRing::Segment segment = ring_.next();
        const std::size_t count = make(triangles, order, first, segment);
        ring_.bind(segment, triangles_binding);
        gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * count));
        ring_.issued(segment);
        statistics_.triangles += count;
    }
    gl.Finish();
    statistics_.draw_s = watch.lap();

    Image image = image_.read();
    context_->check();
    statistics_.read_s = watch.lap();
    return image;
}

} // namespace visorder::detail
