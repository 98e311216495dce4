#include "layering/layer_scan.h"
#include "layering/stopwatch.h"

#include <algorithm>

namespace visorder {

namespace {

class ReadbackScan final : public LayerScan {
public:
    explicit ReadbackScan(int block) : block_(block) {}

    void begin(const ItemBuffer& items, LayerWork& work) override
    {
        items_ = &items;
        work_ = &work;
        state_.assign(items.item_count(), State::other);
        nearest_.resize(items.whole().pixel_count());
        blocks_.clear();
        const glm::ivec2 size = items.size();
        const glm::ivec2 step = block_ > 0 ? glm::ivec2(block_) : size;
        std::size_t place = 0, largest = 0;
        for (int y = 0; y < size.y; y += step.y)
            for (int x = 0; x < size.x; x += step.x) {
                const glm::ivec2 from(x, y);
                blocks_.push_back({{from, glm::min(step, size - from)}, place, false});
                place += blocks_.back().pixels.pixel_count();
                largest = std::max(largest, blocks_.back().pixels.pixel_count());
            }
        farthest_.resize(largest);
        counts_.resize(largest);
        alive_ = items.whole();
    }

    void find_candidates(std::vector<std::uint32_t>& candidates) override
    {
        for (std::uint32_t item : touched_)
            state_[item] = State::other;
        candidates.clear();
        Stopwatch watch;
        for (Block& block : blocks_) {
            std::uint32_t* const pixels = nearest_.data() + block.place;
            items_->read_nearest(block.pixels, pixels);
            work_->pixels_read += block.pixels.pixel_count();
            work_->reading_s += watch.lap();
            block.again = take_candidates({pixels, block.pixels.pixel_count()}, candidates);
            work_->scanning_s += watch.lap();
        }
        if (block_ > 0) {
            std::erase_if(blocks_, [](const Block& block) { return !block.again; });
            alive_ = bounds();
        }
        std::sort(candidates.begin(), candidates.end());
        touched_ = candidates;
        work_->scanning_s += watch.lap();
    }

    Outcome find_covered(std::span<const std::uint32_t>, std::vector<std::uint32_t>& covered) override
    {
        Outcome outcome;
        const std::size_t covered_before = covered.size();
        Stopwatch watch;
        for (Block& block : blocks_) {
            if (!block.again)
                continue;
            const std::size_t count = block.pixels.pixel_count();
            items_->read_farthest(block.pixels, farthest_.data());
            items_->read_stencil(block.pixels, counts_.data());
            work_->pixels_read += 2 * count;
            work_->reading_s += watch.lap();
            block.again = take_covered(nearest_.data() + block.place, count, covered, outcome);
            outcome.again = outcome.again || block.again;
            work_->scanning_s += watch.lap();
        }
        std::sort(covered.begin() + static_cast<std::ptrdiff_t>(covered_before), covered.end());
        for (std::size_t i = covered_before; i < covered.size(); ++i)
            state_[covered[i]] = State::other;
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
        std::size_t place; // of its pixels in nearest_
        bool again;        // another pass of step 4 may find something here
    };
    enum class State : std::uint8_t { other, candidate, just_covered };

    bool take_candidates(std::span<const std::uint32_t> pixels, std::vector<std::uint32_t>& candidates)
    {
        bool any = false;
        std::uint32_t last = 0;
        for (std::uint32_t shown : pixels) {
            if (shown == last)
                continue;
            last = shown;
            if (shown == 0)
                continue;
            any = true;
            if (state_[shown - 1] == State::other) {
                state_[shown - 1] = State::candidate;
                candidates.push_back(shown - 1);
            }
        }
        return any;
    }

    bool take_covered(const std::uint32_t* nearest, std::size_t count, std::vector<std::uint32_t>& covered,
                      Outcome& outcome)
    {
        bool again = false;
        for (std::size_t i = 0; i < count; ++i) {
            if (counts_[i] == 0)
                continue;
            const std::uint32_t shown = farthest_[i];
            if (shown != nearest[i] && state_[shown - 1] == State::candidate) {
                state_[shown - 1] = State::just_covered;
                covered.push_back(shown - 1);
            }
            // Of two, the other is the nearest, unless that was taken off in an earlier pass.
            if (counts_[i] > 2 || (counts_[i] == 2 && state_[nearest[i] - 1] == State::other)) {
                again = true;
                outcome.saturated = outcome.saturated || counts_[i] == 255;
            }
        }
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
    std::vector<Block> blocks_;
    std::vector<State> state_;
    std::vector<std::uint32_t> touched_; // the items whose state is another than `other`
    std::vector<std::uint32_t> nearest_;
    std::vector<std::uint32_t> farthest_;
    std::vector<std::uint8_t> counts_;
    PixelRectangle alive_;
};

} // namespace

std::unique_ptr<LayerScan> make_readback_scan(int block)
{
    return std::make_unique<ReadbackScan>(block);
}

} // namespace visorder
