#include "layering/item_flags.h"
#include "layering/layer_scan.h"
#include "scene/stopwatch.h"

#include <algorithm>
#include <limits>

namespace visorder::detail {

namespace {

// Each invocation scans a square of pixels, from which most atomic operations can be spared.
constexpr int square = 4;
constexpr int group = 8;

constexpr const char* candidates_text = R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usampler2D nearest;
layout(std430, binding = 1) coherent buffer Candidates {
    int left, bottom, right, top; // of what is covered
    uint candidates[];
};
uniform ivec2 from;
uniform ivec2 end;
void main()
{
    ivec2 first = from + 4 * ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = min(first + 4, end);
    uint previous = 0u;
    for (int y = first.y; y < last.y; ++y)
        for (int x = first.x; x < last.x; ++x) {
            uint shown = texelFetch(nearest, ivec2(x, y), 0).r;
            if (shown != previous && shown != 0u) {
                previous = shown;
                uint bit = 1u << ((shown - 1u) % 32u);
                if ((candidates[(shown - 1u) / 32u] & bit) == 0u)
                    atomicOr(candidates[(shown - 1u) / 32u], bit);
            }
        }
    if (previous != 0u) {
        if (left > first.x)
            atomicMin(left, first.x);
        if (bottom > first.y)
            atomicMin(bottom, first.y);
        if (right < last.x)
            atomicMax(right, last.x);
        if (top < last.y)
            atomicMax(top, last.y);
    }
}
)";

constexpr const char* covered_text = R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usampler2D nearest;
layout(binding = 1) uniform usampler2D farthest;
layout(binding = 2) uniform usampler2D stencil;
layout(std430, binding = 1) readonly buffer Remaining { uint remaining[]; };
layout(std430, binding = 2) coherent buffer Covered {
    uint again;
    uint saturated;
    uint covered[];
};
uniform ivec2 from;
uniform ivec2 end;
void main()
{
    ivec2 first = from + 4 * ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = min(first + 4, end);
    for (int y = first.y; y < last.y; ++y)
        for (int x = first.x; x < last.x; ++x) {
            uint count = texelFetch(stencil, ivec2(x, y), 0).r;
            if (count == 0u)
                continue;
            uint front = texelFetch(nearest, ivec2(x, y), 0).r - 1u;
            uint back = texelFetch(farthest, ivec2(x, y), 0).r - 1u;
            uint bit = 1u << (back % 32u);
            if (front != back && (covered[back / 32u] & bit) == 0u)
                atomicOr(covered[back / 32u], bit);
            // Of two, the other is the nearest, unless that was taken off in an earlier pass.
            if (count > 2u || (count == 2u && (remaining[front / 32u] & (1u << (front % 32u))) == 0u)) {
                again = 1u;
                if (count == 255u)
                    saturated = 1u;
            }
        }
}
)";

class ComputeScan final : public LayerScan {
public:
    explicit ComputeScan(const Context& context)
        : context_(&context),
          find_candidates_(context, "candidates of a layer", {{GL_COMPUTE_SHADER, candidates_text}}),
          find_covered_(context, "covered candidates", {{GL_COMPUTE_SHADER, covered_text}}),
          candidates_(context),
          remaining_(context),
          covered_(context)
    {
    }

    void begin(const ItemBuffer& items, LayerWork& work) override
    {
        items_ = &items;
        work_ = &work;
        alive_ = items.whole();
    }

    void find_candidates(std::vector<std::uint32_t>& candidates) override
    {
        candidates.clear();
        Stopwatch watch;
        constexpr auto most = static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max());
        box_ = {most, most, 0, 0};
        candidates_.reset(items_->item_count(), box_);
        context_->gl().BindTextureUnit(0, items_->nearest_image());
        context_->gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, candidates_.id());
        dispatch(find_candidates_);
        work_->scanning_s += watch.lap();
        work_->flags_read += candidates_.read(box_, candidates);
        work_->reading_s += watch.lap();
        if (candidates.empty()) {
            alive_ = {};
        } else {
            const glm::ivec2 low(box_[0], box_[1]), high(box_[2], box_[3]);
            alive_ = {low, high - low};
        }
    }

    Outcome find_covered(std::span<const std::uint32_t> remaining, std::vector<std::uint32_t>& covered) override
    {
        Stopwatch watch;
        const GlFunctions& gl = context_->gl();
        outcome_ = {0, 0};
        remaining_.set(items_->item_count(), {}, remaining);
        covered_.reset(items_->item_count(), outcome_);
        gl.BindTextureUnit(0, items_->nearest_image());
        gl.BindTextureUnit(1, items_->farthest_image());
        gl.BindTextureUnit(2, items_->depth_stencil_image());
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, remaining_.id());
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, covered_.id());
        dispatch(find_covered_);
        work_->scanning_s += watch.lap();
        work_->flags_read += covered_.read(outcome_, covered);
        work_->reading_s += watch.lap();
        return {outcome_[0] != 0, outcome_[1] != 0};
    }

    PixelRectangle alive() const override { return alive_; }

    std::size_t bytes() const override { return candidates_.bytes() + remaining_.bytes() + covered_.bytes(); }

private:
    void dispatch(Program& program)
    {
        const GlFunctions& gl = context_->gl();
        program.set("from", alive_.from);
        program.set("end", alive_.from + alive_.size);
        program.use();
        const glm::ivec2 groups = (alive_.size + square * group - 1) / (square * group);
        gl.DispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y), 1);
        gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
        gl.Finish();
    }

    const Context* context_;
    const ItemBuffer* items_ = nullptr;
    LayerWork* work_ = nullptr;
    Program find_candidates_;
    Program find_covered_;
    ItemFlags candidates_;
    ItemFlags remaining_;
    ItemFlags covered_;
    std::vector<std::uint32_t> box_;
    std::vector<std::uint32_t> outcome_;
    PixelRectangle alive_;
};

} // namespace

std::unique_ptr<LayerScan> make_compute_scan(const Context& context)
{
    return std::make_unique<ComputeScan>(context);
}

} // namespace visorder::detail
