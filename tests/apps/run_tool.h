#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>

namespace visorder::tests {

/// How a run of the command-line tool ended.
struct Outcome {
    int code;
    std::string output; ///< standard output and error
};

/// Runs the tool with arguments as a shell takes them.
inline Outcome run(const std::string& arguments)
{
    const std::string command = std::string(VISORDER_TOOL) + " " + arguments + " 2>&1 </dev/null";
    FILE* pipe = popen(command.c_str(), "r");
    Outcome outcome{-1, {}};
    std::array<char, 4096> buffer;
    for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        outcome.output.append(buffer.data(), n);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); // as shells have it
    return outcome;
}

inline void expect_one_line_and_code_2(const std::string& arguments, const std::string& part)
{
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << arguments << "\n" << outcome.output;
    EXPECT_NE(outcome.output.find(part), std::string::npos) << arguments << "\n" << outcome.output;
}

} // namespace visorder::tests
