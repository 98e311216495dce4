#include "files/input_content.h"

#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <span>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace visorder::detail {

namespace {

constexpr int most_seconds = 20; // without a byte
constexpr std::uint64_t most_bytes_of_pipe = std::uint64_t{1} << 29;

class OpenFile {
public:
    // Opening or reading a pipe must not wait for a writer.
    explicit OpenFile(const std::filesystem::path& path)
        : number_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
    {
        if (number_ < 0)
            throw InputError(fmt::format("cannot be opened: {}", std::generic_category().message(errno)));
    }
    ~OpenFile() { close(number_); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    bool is_regular() const
    {
        struct stat status = {};
        return fstat(number_, &status) == 0 && S_ISREG(status.st_mode);
    }

    /// Reads into the buffer, and returns how many bytes: 0 at the end.
    std::size_t read(std::span<char> buffer) const
    {
        while (true) {
            const ssize_t n = ::read(number_, buffer.data(), buffer.size());
            if (n >= 0)
                return static_cast<std::size_t>(n);
            if (errno == EAGAIN)
                wait();
            else if (errno != EINTR)
                throw InputError(fmt::format("cannot be read: {}", std::generic_category().message(errno)));
        }
    }

private:
    void wait() const
    {
        pollfd entry{number_, POLLIN, 0};
        if (poll(&entry, 1, 1000 * most_seconds) == 0)
            throw InputError(fmt::format("cannot be read: nothing came for {} s", most_seconds));
    }

    int number_;
};

} // namespace

std::string input_content(const std::filesystem::path& path, std::uint64_t most_bytes)
{
    const OpenFile file(path);
    if (!file.is_regular())
        most_bytes = std::min(most_bytes, most_bytes_of_pipe);
    std::string content;
    std::array<char, 1 << 16> buffer{};
    while (const std::size_t n = file.read(buffer)) {
        content.append(buffer.data(), n);
        if (content.size() > most_bytes)
            throw InputError(fmt::format("cannot be read: it has more than {} bytes", most_bytes));
    }
    return content;
}

} // namespace visorder::detail
