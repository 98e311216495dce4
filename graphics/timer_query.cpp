#include "graphics/timer_query.h"

namespace visorder::detail {

TimerQuery::TimerQuery(const Context& context) : context_(&context), query_(context, GlKind::query, GL_TIME_ELAPSED) {}

void TimerQuery::begin()
{
    context_->gl().BeginQuery(GL_TIME_ELAPSED, query_.id());
}

void TimerQuery::end()
{
    context_->gl().EndQuery(GL_TIME_ELAPSED);
}

double TimerQuery::seconds() const
{
    GLuint64 nanoseconds = 0;
    context_->gl().GetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
    return 1e-9 * static_cast<double>(nanoseconds);
}

} // namespace visorder::detail
