#include "layering/pixel_sequences.h"

#include "scene/stopwatch.h"

#include <algorithm>
#include <array>
#include <string>

namespace visorder::detail {

namespace {

constexpr std::size_t head_words = 4;

constexpr const char* append_text = R"(
struct Fragment {
    uint pixel;
    float depth;
    uint item;
};
layout(std430, binding = 1) buffer Fragments {
    uint count;
    uint capacity;
    uint width;
    uint unused;
    Fragment fragments[];
};
void main()
{
    if (covers(gl_FragCoord.xy)) {
        uint at = atomicAdd(count, 1u);
        if (at < capacity) {
            fragments[at].pixel = uint(gl_FragCoord.y) * width + uint(gl_FragCoord.x);
            fragments[at].depth = depth_at(gl_FragCoord.xy);
            fragments[at].item = item;
        }
    }
}
)";

} // namespace

PixelSequences::PixelSequences(ItemBuffer& items, std::uint32_t capacity)
    : items_(items),
      capacity_(capacity),
      append_(items.context(), "fragment lists",
              {{GL_VERTEX_SHADER, ItemBuffer::vertex_shader()},
               {GL_FRAGMENT_SHADER, std::string(ItemBuffer::fragment_preamble()) + append_text}})
{
}

void PixelSequences::visit(std::span<const std::uint32_t> items, const PixelRectangle& within,
                           const std::function<void(std::span<const Fragment>)>& visit)
{
    rendering_s_ = reading_s_ = 0;
    passes_ = 0;
    fragment_count_ = 0;
    if (within.pixel_count() > 0)
        visit_part(items, within, visit);
}

void PixelSequences::visit_part(std::span<const std::uint32_t> items, const PixelRectangle& within,
                                const std::function<void(std::span<const Fragment>)>& visit)
{
    const GlFunctions& gl = items_.context().gl();
    Stopwatch watch;
    if (!list_) {
        list_ = GlObject(items_.context(), GlKind::buffer);
        gl.NamedBufferData(list_.id(), head_words * 4 + capacity_ * sizeof(Fragment), nullptr, GL_DYNAMIC_READ);
    }
    const std::array<std::uint32_t, head_words> head{0, capacity_, static_cast<std::uint32_t>(items_.size().x), 0};
    gl.NamedBufferSubData(list_.id(), 0, sizeof(head), head.data());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, list_.id());
    items_.draw_with(append_, items, within);
    gl.Finish();
    ++passes_;
    rendering_s_ += watch.lap();

    std::uint32_t count = 0;
    gl.GetNamedBufferSubData(list_.id(), 0, sizeof(count), &count);
    const bool splits = within.size.x > 1 || within.size.y > 1;
    if (count > capacity_ && splits) {
        PixelRectangle first = within, second = within;
        const int axis = within.size.y > 1 ? 1 : 0;
        first.size[axis] = within.size[axis] / 2;
        second.from[axis] += first.size[axis];
        second.size[axis] -= first.size[axis];
        visit_part(items, first, visit);
        visit_part(items, second, visit);
        return;
    }
    if (count > capacity_)
        throw GraphicsError("more triangles than a fragment list holds cover one pixel");
    fragments_.resize(count);
    if (count > 0)
        gl.GetNamedBufferSubData(list_.id(), sizeof(head), static_cast<GLsizeiptr>(count * sizeof(Fragment)),
                                 fragments_.data());
    reading_s_ += watch.lap();
    fragment_count_ += count;
    sort_by_pixel(within);
    for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
        if (begin_[i] < begin_[i + 1])
            visit({sorted_.data() + begin_[i], sorted_.data() + begin_[i + 1]});
}

void PixelSequences::sort_by_pixel(const PixelRectangle& within)
{
    const auto width = static_cast<std::uint32_t>(items_.size().x);
    const auto place = [&](const Fragment& fragment) {
        const std::uint32_t x = fragment.pixel % width - static_cast<std::uint32_t>(within.from.x);
        const std::uint32_t y = fragment.pixel / width - static_cast<std::uint32_t>(within.from.y);
        return y * static_cast<std::uint32_t>(within.size.x) + x;
    };
    begin_.assign(within.pixel_count() + 1, 0);
    for (const Fragment& fragment : fragments_)
        ++begin_[place(fragment)];
    std::uint32_t end = 0;
    for (std::uint32_t& count : begin_)
        count = end += count;
    sorted_.resize(fragments_.size());
    for (const Fragment& fragment : fragments_)
        sorted_[--begin_[place(fragment)]] = fragment;
    for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
        std::sort(sorted_.data() + begin_[i], sorted_.data() + begin_[i + 1], [](const Fragment& a, const Fragment& b) {
            return a.depth != b.depth ? a.depth > b.depth : a.item < b.item;
        });
}

std::size_t PixelSequences::bytes() const
{
    const std::size_t of_list = list_ ? head_words * 4 + capacity_ * sizeof(Fragment) : 0;
    return of_list + (fragments_.capacity() + sorted_.capacity()) * sizeof(Fragment) +
           begin_.capacity() * sizeof(begin_[0]);
}

} // namespace visorder::detail
