#include "apps/output_file.h"

#include "scene/error.h"

#include <fmt/format.h>
#include <fstream>
#include <system_error>

namespace visorder::apps {

void write_file(const std::filesystem::path& file, std::string_view text)
{
    const std::filesystem::path part = file.string() + ".part";
    std::error_code error;
    // A device or a pipe is written to as it is.
    if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
        std::ofstream out(file, std::ios::binary);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        if (!out.flush())
            throw InputError(fmt::format("{}: cannot be written", file.string()));
        return;
    }
    {
        std::ofstream out(part, std::ios::binary);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        if (!out.flush()) {
            std::filesystem::remove(part, error);
            throw InputError(fmt::format("{}: cannot be written", file.string()));
        }
    }
    std::filesystem::rename(part, file, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw InputError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
    }
}

} // namespace visorder::apps
