#pragma once

#include "visorder/error.h"
#include "visorder/read_mesh.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace visorder::tests {

/// What reading the file complains of, after the file's name; "" if it reads. Expects one line, and nothing printed.
inline std::string reading_error(const std::filesystem::path& file, const ReadOptions& options = {})
{
    std::string error;
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    try {
        read_mesh(file, options);
    } catch (const InputError& caught) {
        error = caught.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    if (error.empty())
        return error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    EXPECT_TRUE(error.starts_with(file.string() + ": ")) << error;
    return error.substr(std::min(error.size(), file.string().size() + 2));
}

} // namespace visorder::tests
