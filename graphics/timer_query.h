#pragma once

#include "graphics/gl_object.h"

namespace visorder::detail {

/// Seconds that the renderer takes for the commands between `begin` and `end`. One runs at a time in a context, which
/// must be current.
class TimerQuery {
public:
    explicit TimerQuery(const Context& context);
    void begin();
    void end();

    /// Of the last begin and end. Waits until it is known.
    double seconds() const;

private:
    const Context* context_;
    GlObject query_;
};

} // namespace visorder::detail
