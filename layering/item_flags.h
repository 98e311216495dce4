#pragma once

#include "graphics/gl_object.h"

#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

/// One bit an item in a buffer of the renderer, and a few words of its own beside them. The words come first, then the
/// bits of items 0 to 31, and so on. The context must be current.
class ItemFlags {
public:
    explicit ItemFlags(const Context& context) : context_(&context) {}

    /// Makes room, sets the bits to 0 and the words to `words`.
    void reset(std::uint32_t item_count, std::span<const std::uint32_t> words);

    /// Sets the bits of `items` besides.
    void set(std::uint32_t item_count, std::span<const std::uint32_t> words, std::span<const std::uint32_t> items);

    /// Reads all and appends the items whose bits are set, ascending; returns how many words were read.
    std::size_t read(std::vector<std::uint32_t>& words, std::vector<std::uint32_t>& items);

    GLuint id() const { return buffer_.id(); }
    std::size_t bytes() const { return 2 * capacity_ * sizeof(content_[0]); }

private:
    const Context* context_;
    GlObject buffer_;
    std::size_t capacity_ = 0;
    std::vector<std::uint32_t> content_;
};

} // namespace visorder::detail
