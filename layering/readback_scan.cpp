#include "layering/layer_scan.h"
#include "scene/stopwatch.h"

#include <algorithm>
#include <cstring>

namespace visorder::detail {

namespace {

// Whether one of eight counts is above 1.
bool any_above_one(const std::uint8_t* counts)
{
    std::uint64_t eight = 0;
    std::memcpy(&eight, counts, sizeof(eight));
    return (eight & 0xfefefefefefefefeu) != 0;
}

class ReadbackScan final : public LayerScan {
public:
    explicit ReadbackScan(int block) : block_(block) {}

    void begin(const ItemBuffer& items, LayerWork& work) override
    {
        items_ = &items;
        work_ = &work;
        state_.assign(items.item_count() + std::size_t{1}, State::other);
        touched_.clear();
        nearest_.resize(items.whole().pixel_count());
        farthest_.resize(nearest_.size());
        counts_.resize(nearest_.size());
        blocks_.clear();
        const glm::ivec2 size = items.size();
        const glm::ivec2 step = block_ > 0 ? glm::ivec2(block_) : size;
        for (int y = 0; y < size.y; y += step.y)
            for (int x = 0; x < size.x; x += step.x)
                blocks_.push_back({{{x, y}, glm::min(step, size - glm::ivec2(x, y))}, true});
        alive_ = items.whole();
    }

    void find_candidates(std::vector<std::uint32_t>& candidates) override
    {
        for (std::uint32_t item : touched_)
            state_[item + 1] = State::other;
        candidates.clear();
        Stopwatch watch;
        for (Block& block : blocks_)
            block.again = true;
        read([&](const PixelRectangle& run) { items_->read_nearest(run, size().x, nearest_.data()); });
        work_->reading_s += watch.lap();
        for (Block& block : blocks_)
            block.again = mark_candidates(block.pixels);
        if (block_ > 0) {
            std::erase_if(blocks_, [](const Block& block) { return !block.again; });
            alive_ = bounds();
        }
        list(State::candidate, candidates);
        touched_ = candidates;
        first_pass_ = true;
        work_->scanning_s += watch.lap();
    }

    Outcome find_covered(std::span<const std::uint32_t>, std::vector<std::uint32_t>& covered) override
    {
        Stopwatch watch;
        read([&](const PixelRectangle& run) { items_->read_stencil(run, size().x, counts_.data()); });
        work_->reading_s += watch.lap();
        // In the first pass all candidates are there: what is alone at its pixel is the nearest.
        if (first_pass_ && block_ > 0)
            for (Block& block : blocks_)
                block.again = block.again && has_several(block.pixels);
        work_->scanning_s += watch.lap();
        read([&](const PixelRectangle& run) { items_->read_farthest(run, size().x, farthest_.data()); });
        work_->reading_s += watch.lap();

        Outcome outcome;
        any_covered_ = false;
        for (Block& block : blocks_) {
            block.again = block.again && mark_covered(block.pixels, outcome);
            outcome.again = outcome.again || block.again;
        }
        if (any_covered_) {
            const std::size_t covered_before = covered.size();
            list(State::just_covered, covered);
            for (std::size_t i = covered_before; i < covered.size(); ++i)
                state_[covered[i] + 1] = State::other;
        }
        first_pass_ = false;
        work_->scanning_s += watch.lap();
        return outcome;
    }

    PixelRectangle alive() const override { return alive_; }

    std::size_t bytes() const override
    {
        const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
        return size_of(blocks_) + size_of(state_) + size_of(touched_) + size_of(nearest_) + size_of(farthest_) +
               size_of(counts_);
    }

private:
    struct Block {
        PixelRectangle pixels;
        bool again; // to be read by the next pass
    };
    enum class State : std::uint8_t { other, candidate, just_covered };

    glm::ivec2 size() const { return items_->size(); }

    // Reads the blocks that are to be read, side by side where they lie so.
    template <class Read>
    void read(const Read& read_run)
    {
        for (std::size_t begin = 0, end = 0; begin < blocks_.size(); begin = end) {
            end = begin + 1;
            if (!blocks_[begin].again)
                continue;
            PixelRectangle run = blocks_[begin].pixels;
            for (; end < blocks_.size() && blocks_[end].again; ++end) {
                const PixelRectangle& next = blocks_[end].pixels;
                if (next.from != glm::ivec2(run.from.x + run.size.x, run.from.y))
                    break;
                run.size.x += next.size.x;
            }
            read_run(run);
            work_->pixels_read += run.pixel_count();
        }
    }

    // Calls body(first, last) for the pixels of each row.
    template <class Body>
    void for_rows(const PixelRectangle& pixels, const Body& body) const
    {
        for (int y = pixels.from.y; y < pixels.from.y + pixels.size.y; ++y) {
            const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(size().x) +
                                      static_cast<std::size_t>(pixels.from.x);
            body(first, first + static_cast<std::size_t>(pixels.size.x));
        }
    }

    // Marks the items shown; what shows none marks place 0.
    bool mark_candidates(const PixelRectangle& pixels)
    {
        std::uint32_t any = 0;
        for_rows(pixels, [&](std::size_t i, std::size_t end) {
            for (; i < end; ++i) {
                any |= nearest_[i];
                state_[nearest_[i]] = State::candidate;
            }
        });
        return any != 0;
    }

    // Appends the items with a state, ascending.
    void list(State state, std::vector<std::uint32_t>& items) const
    {
        std::size_t place = 1;
        while (place < state_.size()) {
            std::uint64_t eight = 0;
            if (place + 8 <= state_.size())
                std::memcpy(&eight, &state_[place], sizeof(eight));
            const std::size_t end = std::min(place + 8, state_.size());
            if (eight != 0 || end < place + 8)
                for (std::size_t i = place; i < end; ++i)
                    if (state_[i] == state)
                        items.push_back(static_cast<std::uint32_t>(i - 1));
            place = end;
        }
    }

    bool has_several(const PixelRectangle& pixels) const
    {
        bool several = false;
        for_rows(pixels, [&](std::size_t i, std::size_t end) {
            for (; i + 8 <= end; i += 8)
                several = several || any_above_one(counts_.data() + i);
            for (; i < end; ++i)
                several = several || counts_[i] > 1;
        });
        return several;
    }

    bool mark_covered(const PixelRectangle& pixels, Outcome& outcome)
    {
        bool again = false;
        const int least = first_pass_ ? 2 : 1;
        for_rows(pixels, [&](std::size_t i, std::size_t end) {
            for (; i < end; ++i) {
                if (counts_[i] < least) {
                    while (least == 2 && i + 9 <= end && !any_above_one(counts_.data() + i + 1))
                        i += 8;
                    continue;
                }
                const std::uint32_t shown = farthest_[i];
                if (shown != nearest_[i]) {
                    state_[shown] = State::just_covered;
                    any_covered_ = true;
                }
                // Of two, the other is the nearest, unless that was taken off in an earlier pass.
                if (counts_[i] > 2 || (counts_[i] == 2 && state_[nearest_[i]] == State::other)) {
                    again = true;
                    outcome.saturated = outcome.saturated || counts_[i] == 255;
                }
            }
        });
        return again;
    }

    PixelRectangle bounds() const
    {
        if (blocks_.empty())
            return {};
        glm::ivec2 low = blocks_.front().pixels.from, high = low;
        for (const Block& block : blocks_) {
            low = glm::min(low, block.pixels.from);
            high = glm::max(high, block.pixels.from + block.pixels.size);
        }
        return {low, high - low};
    }

    int block_;
    const ItemBuffer* items_ = nullptr;
    LayerWork* work_ = nullptr;
    std::vector<Block> blocks_;          // alive; row by row from the bottom, from the left
    std::vector<State> state_;           // of item i at place i + 1, as an image has it
    std::vector<std::uint32_t> touched_; // the items whose state may be another than `other`
    // Whole images, of which the alive blocks are read.
    std::vector<std::uint32_t> nearest_;
    std::vector<std::uint32_t> farthest_;
    std::vector<std::uint8_t> counts_;
    PixelRectangle alive_;
    bool first_pass_ = true; // of step 4
    bool any_covered_ = false;
};

} // namespace

std::unique_ptr<LayerScan> make_readback_scan(int block)
{
    return std::make_unique<ReadbackScan>(block);
}

} // namespace visorder::detail
