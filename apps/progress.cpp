#include "apps/progress.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace visorder::apps {

Progress::Progress() : on_terminal_(isatty(STDERR_FILENO) != 0 && isatty(STDOUT_FILENO) != 0) {}

Progress::~Progress()
{
    if (shown_)
        fmt::print(stderr, "\r\033[K");
}

void Progress::show(const std::string& what)
{
    if (!on_terminal_)
        return;
    shown_ = true;
    fmt::print(stderr, "\r\033[K{}", what);
    std::fflush(stderr);
}

} // namespace visorder::apps
