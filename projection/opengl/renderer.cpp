#include "projection/opengl/renderer.h"

#include "projection/near_cell.h"
#include "projection/opengl/integrator_shaders.h"
#include "projection/opengl/plane_triangles.h"
#include "projection/opengl/projector_shaders.h"
#include "projection/opengl/shader_thick_triangles.h"
#include "projection/opengl/silhouette_triangles.h"
#include "scene/orientations.h"
#include "scene/scalar_interval.h"
#include "scene/stopwatch.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/task_group.h>

namespace visorder::detail {

namespace {

constexpr std::size_t stretch_cells = 16384;
constexpr std::size_t block_cells = 1024;
// Room for as many records as cells, on average; one segment is filled and another is read from.
constexpr std::size_t most_record_bytes = 384;
constexpr std::size_t ring_segments = 4;
constexpr std::size_t ring_segment_bytes = stretch_cells * most_record_bytes;
// For what has no room there.
constexpr std::size_t rest_segment_bytes = std::size_t{1} << 20;

constexpr std::size_t most_points = std::size_t{1} << 30;
constexpr GLuint triangles_binding = 1;
constexpr GLuint near_cells_binding = 3;
constexpr std::size_t near_segment_records = 4096;

const Scene& checked(const Scene& scene)
{
    if (!scene.is_tetrahedral())
        throw InputError(scene.is_surface() ? "the renderer draws volumes, and this is a surface of triangles"
                                            : "the renderer takes tetrahedra; subdivide the mesh first");
    const Mesh& mesh = scene.mesh();
    if (mesh.scalars.empty())
        throw InputError("the mesh has no scalars to draw");
    for (std::size_t i = 0; i < mesh.scalars.size(); ++i)
        if (!std::isfinite(mesh.scalars[i]))
            throw InputError(fmt::format("point {}: scalar {} is not finite", scene.caller_points()[i],
                                         static_cast<double>(mesh.scalars[i])));
    if (mesh.points.size() > most_points)
        throw InputError(fmt::format("{} points; the renderer takes 2^30", mesh.points.size()));
    return scene;
}

const RenderOptions& checked(const RenderOptions& options)
{
    BlendingImage::check_bits(options.blending_bits);
    if (options.projector == Projector::planes && options.integrator == Integrator::linear)
        throw InputError("the integrator linear interpolates from the thickest point, which the projector planes does "
                         "not have: take silhouette or thick");
    return options;
}

Program make_program(const Context& context, const char* title, const ShaderPair& shaders)
{
    const Context::Current current(context);
    return {context, title, {{GL_VERTEX_SHADER, shaders.vertex}, {GL_FRAGMENT_SHADER, shaders.fragment}}};
}

ScaledScalars scaled_scalars(const Mesh& mesh)
{
    const auto [lowest, highest] = scalar_interval(mesh).value();
    return {mesh.scalars, lowest, highest > lowest ? highest - lowest : 1};
}

// Random lines cross a convex body along four times its volume over its surface in the mean (Cauchy).
WayLengths way_lengths(const Mesh& mesh)
{
    struct Sums {
        double volume = 0, surface = 0, longest = 0;
    };
    using Range = oneapi::tbb::blocked_range<std::size_t>;
    const auto add = [&](const Range& range, Sums sums) {
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
            const auto v = mesh.cell(static_cast<CellId>(cell));
            const std::array<glm::dvec3, 4> p{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]],
                                              mesh.points[v[3]]};
            sums.volume += std::abs(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0])) / 6;
            for (std::size_t i = 0; i < 4; ++i) {
                sums.surface += glm::length(glm::cross(p[(i + 1) % 4] - p[i], p[(i + 2) % 4] - p[i])) / 2;
                for (std::size_t k = 0; k < i; ++k)
                    sums.longest = std::max(sums.longest, glm::length(p[i] - p[k]));
            }
        }
        return sums;
    };
    const Sums sums = oneapi::tbb::parallel_deterministic_reduce(
        Range(0, mesh.cell_count(), 65536), Sums{}, add, [](const Sums& a, const Sums& b) {
            return Sums{a.volume + b.volume, a.surface + b.surface, std::max(a.longest, b.longest)};
        });
    const double longest = sums.longest > 0 ? sums.longest : 1;
    return {sums.volume > 0 ? 4 * sums.volume / sums.surface : longest, longest};
}

FunctionTextures make_textures(const Context& context, const Scene& scene, const RenderOptions& options)
{
    const Context::Current current(context);
    return {context, options.integrator, options.tables, way_lengths(scene.mesh())};
}

std::unique_ptr<const CellTriangles> make_triangles(const RenderOptions& options, const TriangleSources& sources)
{
    if (options.projector == Projector::planes)
        return std::make_unique<PlaneTriangles>(sources);
    if (options.projector == Projector::thick_gpu)
        return std::make_unique<ShaderThickTriangles>(sources);
    return std::make_unique<SilhouetteTriangles>(sources, options.integrator, options.projector == Projector::thick);
}

// Whether the fragments of triangles do.
bool looks_up_pieces(const RenderOptions& options)
{
    return options.integrator == Integrator::exact &&
           (options.projector == Projector::planes || options.projector == Projector::thick_gpu);
}

void set_rays(Program& program, const Screen& screen)
{
    const glm::mat3 rays(screen.rays());
    program.set("ray_x", rays[0]);
    program.set("ray_y", rays[1]);
    program.set("ray_1", rays[2]);
}

UploadRing make_ring(const Context& context, std::size_t segment_bytes)
{
    const Context::Current current(context);
    return {context, segment_bytes, ring_segments};
}

} // namespace

/// What one part of the order becomes. Blocks are made by threads of their own, each into its part of a segment.
struct ProjectionRenderer::Stretch {
    struct Block {
        RecordSink records;
        std::vector<CellApart> apart;
    };
    UploadRing::Segment segment;
    std::vector<Block> blocks;
    std::vector<CellId> cells; // inner numbering
    double seconds = 0;
};

ProjectionRenderer::ProjectionRenderer(const Context& context, const Scene& scene, const TransferFunction& function,
                                       const RenderOptions& options)
    : context_(&context),
      scene_(checked(scene)),
      options_(checked(options)),
      software_(options.for_software.value_or(context.is_software())),
      lattice_(raster_lattice(context)),
      image_(context, options.blending_bits, software_),
      near_cell_program_(make_program(context, "near cells", near_cell_shaders(options.integrator, software_))),
      function_(make_textures(context, scene, options)),
      ring_(make_ring(context, ring_segment_bytes)),
      rest_ring_(make_ring(context, rest_segment_bytes)),
      near_ring_(make_ring(context, near_segment_records * sizeof(NearCellRecord)))
{
    const Context::Current current(context);
    scalars_ = scaled_scalars(scene.mesh());

    const Orientations& orientations = scene.orientations();
    turned_.resize(scene.cell_count());
    std::transform(orientations.sign.begin(), orientations.sign.end(), turned_.begin(),
                   [](std::int8_t sign) { return static_cast<std::uint8_t>(sign < 0); });

    inner_cells_.resize(scene.cell_count());
    for (CellId inner = 0; inner < scene.cell_count(); ++inner)
        inner_cells_[scene.caller_cells()[inner]] = inner;

    no_attributes_ = GlObject(context, GlKind::vertex_array);
    attributes_ = GlObject(context, GlKind::vertex_array);
    for (int i = 0; i < 2; ++i)
        stretches_.push_back(std::make_unique<Stretch>());
    set_transfer_function(function);
}

ProjectionRenderer::~ProjectionRenderer() = default;

void ProjectionRenderer::set_transfer_function(const TransferFunction& function)
{
    const Context::Current current(*context_);
    pieces_ = optical_pieces(function, scalars_.lowest, scalars_.range);
    function_.set(pieces_);
    if (!needs_optics(options_.integrator))
        return;
    const auto& scalars = scene_.mesh().scalars;
    optics_.resize(scalars.size());
    oneapi::tbb::parallel_for(std::size_t{0}, scalars.size(), [&](std::size_t i) {
        const OpticalPoint point = function.at(static_cast<double>(scalars[i]));
        optics_[i] = glm::vec4(point.colour, point.extinction);
    });
}

std::size_t ProjectionRenderer::records_a_block(const CellTriangles& triangles)
{
    return ring_segment_bytes / (stretch_cells / block_cells) / triangles.record_bytes();
}

void ProjectionRenderer::prepare(const Order& order, std::size_t first, const CellTriangles& triangles,
                                 Stretch& stretch) const
{
    Stopwatch watch;
    const std::size_t cells = std::min(stretch_cells, order.back_to_front.size() - first);
    const std::size_t blocks = (cells + block_cells - 1) / block_cells;
    const std::size_t room = records_a_block(triangles) * triangles.record_bytes();
    stretch.cells.resize(cells);
    stretch.blocks.resize(blocks);
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
        Stretch::Block& block = stretch.blocks[b];
        const std::size_t begin = b * block_cells;
        const std::size_t count = std::min(block_cells, cells - begin);
        for (std::size_t i = begin; i < begin + count; ++i) {
            const CellId cell = order.back_to_front[first + i];
            if (cell >= inner_cells_.size())
                throw InputError(fmt::format("the order lists cell {}, of {}", cell, inner_cells_.size()));
            stretch.cells[i] = inner_cells_[cell];
        }
        block.apart.clear();
        block.records.start(stretch.segment.memory.subspan(b * room, room), triangles.record_bytes());
        triangles.make(std::span(stretch.cells).subspan(begin, count), block.records, block.apart);
    });
    stretch.seconds = watch.lap();
}

Program& ProjectionRenderer::triangle_program(const Screen& screen)
{
    std::optional<Program>& program = triangle_programs_[screen.perspective() ? 1 : 0];
    if (!program)
        program.emplace(
            make_program(*context_, "cell projection",
                         triangle_shaders(options_.projector, options_.integrator, screen.perspective(), software_)));
    return *program;
}

void ProjectionRenderer::issue(const Stretch& stretch, const Screen& screen, const CellTriangles& triangles,
                               const Program& program)
{
    const std::size_t record_bytes = triangles.record_bytes();
    const std::size_t room = records_a_block(triangles);
    bind(ring_, stretch.segment, triangles);
    for (std::size_t b = 0; b < stretch.blocks.size(); ++b) {
        const Stretch::Block& block = stretch.blocks[b];
        std::span<const CellApart> apart = block.apart;
        const RecordSink& records = block.records;
        draw_records({b * room, 0, records.count_in_room()}, apart, screen, triangles, program);
        for (std::size_t drawn = records.count_in_room(); drawn < records.count();) {
            const UploadRing::Segment segment = rest_ring_.next();
            const std::size_t count = std::min(records.count() - drawn, segment.memory.size() / record_bytes);
            const std::size_t begin = drawn - records.count_in_room();
            std::copy_n(records.rest().data() + begin * record_bytes, count * record_bytes, segment.memory.data());
            bind(rest_ring_, segment, triangles);
            draw_records({0, drawn, count}, apart, screen, triangles, program);
            rest_ring_.issued(segment);
            drawn += count;
            if (drawn == records.count())
                bind(ring_, stretch.segment, triangles);
        }
        for (const CellApart& cell : apart)
            add_near_cell(screen, cell.cell);
        statistics_.triangles += records.count() * triangles.triangles_a_record();
    }
    ring_.issued(stretch.segment);
    statistics_.prepare_s += stretch.seconds;
}

void ProjectionRenderer::bind(const UploadRing& ring, const UploadRing::Segment& segment,
                              const CellTriangles& triangles) const
{
    if (triangles.vertex_attributes() > 0)
        ring.bind_vertices(segment, attributes_.id(), triangles.record_bytes() / 3);
    else
        ring.bind(segment, triangles_binding);
}

// Takes off the front of `apart` those that it draws: all before a record in the range.
void ProjectionRenderer::draw_records(const Records& records, std::span<const CellApart>& apart, const Screen& screen,
                                      const CellTriangles& triangles, const Program& program)
{
    const GlFunctions& gl = context_->gl();
    const std::size_t vertices = 3 * triangles.triangles_a_record();
    const std::size_t end = records.number + records.count;
    for (std::size_t drawn = records.number; drawn < end;) {
        for (; !apart.empty() && apart.front().records_before == drawn; apart = apart.subspan(1))
            add_near_cell(screen, apart.front().cell);
        draw_near_cells();
        const std::size_t next = apart.empty() ? end : std::min<std::size_t>(end, apart.front().records_before);
        program.use();
        gl.BindVertexArray(triangles.vertex_attributes() > 0 ? attributes_.id() : no_attributes_.id());
        gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(vertices * (records.place + drawn - records.number)),
                      static_cast<GLsizei>(vertices * (next - drawn)));
        drawn = next;
    }
}

void ProjectionRenderer::add_near_cell(const Screen& screen, CellId cell)
{
    const auto v = scene_.mesh().cell(cell);
    const auto& points = scene_.mesh().points;
    // In the order of their numbers, so that two cells agree about the face between them.
    std::array<PointId, 4> order{v[0], v[1], v[2], v[3]};
    std::sort(order.begin(), order.end());
    std::array<glm::dvec3, 4> in_space{};
    std::array<glm::dvec3, 4> on_screen{};
    std::array<double, 4> scalars{};
    bool placed = true;
    for (std::size_t i = 0; i < 4; ++i) {
        in_space[i] = points[order[i]];
        on_screen[i] = points_.at[order[i]];
        scalars[i] = scalars_[order[i]];
        placed = placed && (points_.sides[order[i]] & sides::off_lattice) == 0;
    }
    const std::optional<NearCell> near =
        placed ? near_cell_on_screen(screen, on_screen, scalars) : near_cell(screen, in_space, scalars);
    if (!near)
        return;
    if (near_segment_ && near_drawn_ + near_pending_ == near_segment_records) {
        draw_near_cells();
        near_ring_.issued(*near_segment_);
        near_segment_.reset();
    }
    if (!near_segment_) {
        near_segment_ = near_ring_.next();
        near_drawn_ = 0;
    }
    const NearCellRecord record = record_of(*near);
    std::memcpy(near_segment_->memory.data() + (near_drawn_ + near_pending_) * sizeof(record), record.data(),
                sizeof(record));
    ++near_pending_;
    ++statistics_.near_cells;
}

// All that have been added since the last time, in their sequence.
void ProjectionRenderer::draw_near_cells()
{
    if (near_pending_ == 0)
        return;
    near_ring_.bind(*near_segment_, near_cells_binding);
    near_cell_program_.set("first_record", static_cast<int>(near_drawn_));
    near_cell_program_.use();
    const GlFunctions& gl = context_->gl();
    gl.BindVertexArray(no_attributes_.id());
    gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(near_pending_));
    near_drawn_ += near_pending_;
    near_pending_ = 0;
}

void ProjectionRenderer::set_up(const Screen& screen, Program& triangle_program)
{
    image_.start(screen.size(), screen.centre(), lattice_);

    near_cell_program_.set("half_range", static_cast<float>(lattice_.half_range));
    near_cell_program_.set("centre", glm::vec2(screen.centre()));
    set_rays(near_cell_program_, screen);
    function_.introduce(near_cell_program_, needs_optics(options_.integrator));
    set_up_triangles(triangle_program, screen);
    function_.introduce(triangle_program, looks_up_pieces(options_));
    function_.bind();
}

void ProjectionRenderer::set_up_triangles(Program& program, const Screen& screen) const
{
    const bool planes = options_.projector == Projector::planes;
    const bool in_shader = options_.projector == Projector::thick_gpu;
    const bool linear = options_.integrator == Integrator::linear;
    const bool rows = interpolates_rows(options_.projector, software_);
    if (planes || in_shader || rows || (screen.perspective() && !linear))
        program.set("centre", glm::vec2(screen.centre()));
    if (planes || in_shader || rows)
        program.set("half_range", static_cast<float>(lattice_.half_range));
    if (planes)
        program.set("inverse_distance", static_cast<float>(screen.inverse_distance()));
    if (in_shader) {
        program.set("lattice_steps", static_cast<float>(lattice_.steps));
        program.set("inverse_distance", screen.inverse_distance());
    }
    if (planes || (in_shader && linear)) {
        set_rays(program, screen);
    } else if (screen.perspective() && !linear) {
        const glm::dvec3& x = screen.rays()[0];
        const glm::dvec3& y = screen.rays()[1];
        const glm::dvec3& one = screen.rays()[2];
        program.set("ray_constant", glm::vec3(glm::dot(one, one), 2 * glm::dot(one, x), 2 * glm::dot(one, y)));
        program.set("ray_quadratic", glm::vec3(glm::dot(x, x), 2 * glm::dot(x, y), glm::dot(y, y)));
    } else if (in_shader) {
        program.set("length_a_depth", static_cast<float>(glm::length(screen.rays()[2])));
    }
}

void ProjectionRenderer::set_up_attributes(const CellTriangles& triangles)
{
    const GlFunctions& gl = context_->gl();
    const GLuint array = attributes_.id();
    for (; attribute_count_ < triangles.vertex_attributes(); ++attribute_count_) {
        const auto attribute = static_cast<GLuint>(attribute_count_);
        gl.EnableVertexArrayAttrib(array, attribute);
        gl.VertexArrayAttribFormat(array, attribute, 4, GL_FLOAT, GL_FALSE,
                                   attribute * static_cast<GLuint>(sizeof(glm::vec4)));
        gl.VertexArrayAttribBinding(array, attribute, 0);
    }
}

Image ProjectionRenderer::draw(const View& view, const Order& order)
{
    if (order.back_to_front.size() != scene_.cell_count())
        throw InputError(
            fmt::format("the order lists {} cells; the scene has {}", order.back_to_front.size(), scene_.cell_count()));
    const Context::Current current(*context_);
    statistics_ = {};
    near_segment_.reset();
    near_pending_ = 0;
    Stopwatch watch;
    const Screen screen(view, scene_.bounds());
    Program& program = triangle_program(screen);
    set_up(screen, program);
    points_.place(screen, lattice_, scene_.mesh().points);
    statistics_.place_s = watch.lap();

    const VisibleCells visible(scene_, turned_, points_, screen, lattice_);
    const bool linear = options_.integrator == Integrator::linear;
    const bool exact = options_.integrator == Integrator::exact;
    const TriangleSources sources{&screen, &visible, scalars_, optics_, linear, exact ? &pieces_ : nullptr};
    const std::unique_ptr<const CellTriangles> made = make_triangles(options_, sources);
    const CellTriangles& triangles = *made;
    set_up_attributes(triangles);
    const std::size_t cells = order.back_to_front.size();
    stretches_[0]->segment = ring_.next();
    prepare(order, 0, triangles, *stretches_[0]);
    for (std::size_t first = 0, i = 0; first < cells; first += stretch_cells, ++i) {
        // While this stretch is drawn, the next one is made.
        oneapi::tbb::task_group group;
        if (Stretch& later = *stretches_[(i + 1) % 2]; first + stretch_cells < cells) {
            later.segment = ring_.next();
            group.run([&, this] { prepare(order, first + stretch_cells, triangles, later); });
        }
        try {
            issue(*stretches_[i % 2], screen, triangles, program);
        } catch (...) {
            group.wait();
            throw;
        }
        group.wait();
    }
    draw_near_cells();
    if (near_segment_)
        near_ring_.issued(*near_segment_);
    near_segment_.reset();
    context_->gl().Finish();
    statistics_.draw_s = watch.lap();

    Image image = image_.read();
    context_->check();
    statistics_.read_s = watch.lap();
    return image;
}

} // namespace visorder::detail
