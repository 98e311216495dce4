#include "layering/item_flags.h"

#include <algorithm>
#include <bit>

namespace visorder::detail {

void ItemFlags::reset(std::uint32_t item_count, std::span<const std::uint32_t> words)
{
    set(item_count, words, {});
}

void ItemFlags::set(std::uint32_t item_count, std::span<const std::uint32_t> words,
                    std::span<const std::uint32_t> items)
{
    content_.assign(words.size() + (item_count + std::size_t{31}) / 32, 0);
    std::copy(words.begin(), words.end(), content_.begin());
    for (std::uint32_t item : items)
        content_[words.size() + item / 32] |= 1u << item % 32;
    const GlFunctions& gl = context_->gl();
    if (!buffer_ || content_.size() > capacity_) {
        buffer_ = GlObject(*context_, GlKind::buffer);
        capacity_ = content_.size();
        gl.NamedBufferData(buffer_.id(), static_cast<GLsizeiptr>(capacity_ * sizeof(content_[0])), nullptr,
                           GL_DYNAMIC_COPY);
    }
    gl.NamedBufferSubData(buffer_.id(), 0, static_cast<GLsizeiptr>(content_.size() * sizeof(content_[0])),
                          content_.data());
}

std::size_t ItemFlags::read(std::vector<std::uint32_t>& words, std::vector<std::uint32_t>& items)
{
    context_->gl().GetNamedBufferSubData(
        buffer_.id(), 0, static_cast<GLsizeiptr>(content_.size() * sizeof(content_[0])), content_.data());
    std::copy_n(content_.begin(), words.size(), words.begin());
    for (std::size_t i = words.size(); i < content_.size(); ++i)
        for (std::uint32_t bits = content_[i]; bits != 0; bits &= bits - 1)
            items.push_back(static_cast<std::uint32_t>(32 * (i - words.size())) +
                            static_cast<std::uint32_t>(std::countr_zero(bits)));
    return content_.size();
}

} // namespace visorder::detail
