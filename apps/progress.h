#pragma once

#include <string>

namespace visorder::apps {

/// One line on standard error that says what is being done, replaced as work goes on and cleared at the end. Silent
/// where standard error or standard output is not a terminal.
class Progress {
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(const std::string& what);

private:
    bool on_terminal_;
    bool shown_ = false;
};

} // namespace visorder::apps
