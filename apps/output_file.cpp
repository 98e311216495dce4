#include "apps/output_file.h"

#include "visorder/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace visorder::apps {

namespace {

using Path = std::filesystem::path;

[[noreturn]] void fail(const Path& file, int error)
{
    throw InputError(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(error)));
}

std::optional<struct stat> status_of(const Path& file)
{
    struct stat status {};
    return stat(file.c_str(), &status) == 0 ? std::optional(status) : std::nullopt;
}

/// Where the links of a name lead, also to a file that is not there yet.
Path followed(Path file)
{
    constexpr int most_links = 40; // as many as the system follows
    std::error_code error;
    for (int i = 0; i < most_links && std::filesystem::is_symlink(file, error); ++i) {
        const Path target = std::filesystem::read_symlink(file, error);
        file = target.is_absolute() ? target : file.parent_path() / target;
    }
    return file;
}

/// Writes all of the text, or returns the system's error.
int write_all(int descriptor, std::string_view text)
{
    while (!text.empty()) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return errno;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

/// Opens, writes and closes; returns the system's error.
int write_new(const Path& file, int flags, std::string_view text)
{
    const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
    if (descriptor < 0)
        return errno;
    const int error = write_all(descriptor, text);
    const bool closed = close(descriptor) == 0;
    return error != 0 ? error : closed ? 0 : errno;
}

/// Whether a file is written to as it is, rather than replaced.
bool in_place(const struct stat& status)
{
    return !S_ISREG(status.st_mode) || status.st_nlink > 1;
}

Path part_of(const Path& target)
{
    return target.string() + ".part";
}

/// Makes an empty file beside the target, so that one can be put in its place; returns the system's error.
int try_part(const Path& target)
{
    const Path part = part_of(target);
    const int error = write_new(part, O_CREAT | O_EXCL, "");
    if (error == 0)
        unlink(part.c_str());
    return error == EEXIST ? 0 : error;
}

} // namespace

bool is_standard_output(const Path& file)
{
    if (file == "-")
        return true;
    const auto status = status_of(file);
    struct stat output {};
    return status && fstat(STDOUT_FILENO, &output) == 0 && status->st_dev == output.st_dev &&
           status->st_ino == output.st_ino && file != "/dev/null";
}

void write_file(const Path& file, std::string_view text)
{
    if (is_standard_output(file)) {
        std::fflush(stdout);
        if (const int error = write_all(STDOUT_FILENO, text); error != 0)
            fail(file, error);
        return;
    }
    const auto status = status_of(file);
    if (status && in_place(*status)) {
        if (const int error = write_new(file, S_ISREG(status->st_mode) ? O_TRUNC : 0, text); error != 0)
            fail(file, error);
        return;
    }
    const Path target = followed(file);
    const Path part = part_of(target);
    int error = write_new(part, O_CREAT | O_TRUNC, text);
    if (error == 0 && status)
        error = chmod(part.c_str(), status->st_mode & 07777) == 0 ? 0 : errno;
    if (error == 0 && rename(part.c_str(), target.c_str()) != 0)
        error = errno;
    if (error == 0)
        return;
    unlink(part.c_str());
    // In a folder that takes no new file, one that is there may still be written to.
    if (status && error == EACCES)
        error = write_new(target, O_TRUNC, text);
    if (error != 0)
        fail(file, error);
}

void require_writable(const Path& file)
{
    if (is_standard_output(file))
        return;
    const auto status = status_of(file);
    if (status && S_ISDIR(status->st_mode))
        fail(file, EISDIR);
    if (status && access(file.c_str(), W_OK) != 0)
        fail(file, errno);
    if (status && in_place(*status))
        return;
    const int error = try_part(followed(file));
    if (error != 0 && !(status && error == EACCES))
        fail(file, error);
}

void require_writable_folder(const Path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        fail(folder, error.value());
    if (const int part_error = try_part(folder / "visorder"); part_error != 0)
        fail(folder, part_error);
}

std::FILE* message_stream(std::initializer_list<Path> outputs)
{
    const bool taken = std::any_of(outputs.begin(), outputs.end(),
                                   [](const Path& file) { return !file.empty() && is_standard_output(file); });
    return taken ? stderr : stdout;
}

std::string small_ending(const Path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

} // namespace visorder::apps
