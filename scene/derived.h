#pragma once

#include <memory>
#include <oneapi/tbb/collaborative_call_once.h>

namespace visorder::detail {

/// A value made by the first thread that asks for it, while other threads that ask wait or help. Thread-safe. If making
/// it throws, the exception goes to all who waited, and the next to ask tries again.
template <class T>
class Derived {
public:
    template <class Make>
    const T& get(Make&& make) const
    {
        oneapi::tbb::collaborative_call_once(once_, [&] { value_ = std::make_unique<const T>(make()); });
        return *value_;
    }

private:
    mutable oneapi::tbb::collaborative_once_flag once_;
    mutable std::unique_ptr<const T> value_;
};

} // namespace visorder::detail
