#pragma once

#include "parallel/large_array.h"

#include <cstddef>
#include <span>

namespace visorder::detail {

/// Takes records of one size, one after the other: into memory that it is given, such as the renderer's, and, what is
/// too much for that, into memory of its own, which it keeps.
class RecordSink {
public:
    /// Begins anew.
    void start(std::span<std::byte> room, std::size_t record_bytes)
    {
        room_ = room;
        record_bytes_ = record_bytes;
        most_in_room_ = room.size() / record_bytes;
        count_ = 0;
    }

    /// For the next record; valid until the next call.
    std::byte* next()
    {
        if (count_ < most_in_room_)
            return room_.data() + count_++ * record_bytes_;
        const std::size_t begin = (count_++ - most_in_room_) * record_bytes_;
        if (rest_.size() < begin + record_bytes_)
            rest_.resize(2 * (begin + record_bytes_));
        return rest_.data() + begin;
    }

    std::size_t count() const { return count_; }
    std::size_t count_in_room() const { return count_ < most_in_room_ ? count_ : most_in_room_; }
    /// The records that were too many.
    std::span<const std::byte> rest() const { return {rest_.data(), (count_ - count_in_room()) * record_bytes_}; }

private:
    std::span<std::byte> room_;
    std::size_t record_bytes_ = 1;
    std::size_t most_in_room_ = 0;
    std::size_t count_ = 0;
    LargeArray<std::byte> rest_;
};

} // namespace visorder::detail
