// visorder-read: reads one mesh for another process, which gives the request as standard input and takes the result,
// after one byte that says that the program has started, from standard output (see files/reader_process.h).

#include "files/mesh_file_bytes.h"
#include "visorder/error.h"
#include "visorder/read_mesh.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <limits>
#include <malloc.h>
#include <new>
#include <oneapi/tbb/global_control.h>
#include <span>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace {

using namespace visorder;
using namespace visorder::detail;

void read_from(int file, std::span<std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t n = read(file, bytes.data(), bytes.size());
        if (n == 0)
            throw InputError("the request is cut short");
        if (n < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "no request");
        bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    }
}

void write_to(int file, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t n = write(file, bytes.data(), bytes.size());
        if (n < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "cannot pass on what was read");
        bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    }
}

void limit(int resource, rlim_t most)
{
    rlimit current{};
    getrlimit(static_cast<__rlimit_resource>(resource), &current);
    current.rlim_max = std::min(current.rlim_max, most);
    current.rlim_cur = std::min(current.rlim_max, most);
    setrlimit(static_cast<__rlimit_resource>(resource), &current);
}

void set_limits(const ReadRequest& request)
{
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, 2 * request.processor_seconds + 1); // should the other process have gone; it counts all threads
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which reserve nearly all there is
    limit(RLIMIT_AS, request.memory_bytes);
#endif
    mallopt(M_ARENA_MAX, 1); // each thread's own would count towards the limit whole
    // Memory given back to the system and taken again costs more than reading a file does.
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TOP_PAD, 64 << 20);
}

ReadResult result_of_reading(const ReadRequest& request)
{
    try {
        return read_mesh(request.file, request.options);
    } catch (const InputError& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        return request.file + ": cannot be read: it asks for more memory than there is";
    } catch (const std::exception& error) {
        return request.file + ": cannot be read: " + error.what();
    }
}

} // namespace

int main()
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // What readers print must not get into the result.
    const int result = dup(STDOUT_FILENO);
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (result < 0 || nothing < 0 || dup2(nothing, STDOUT_FILENO) < 0)
        return 1;
    const auto give = [&](std::span<const std::byte> bytes) { write_to(result, bytes); };
    try {
        const ReadRequest request = read_request([](std::span<std::byte> bytes) { read_from(STDIN_FILENO, bytes); });
        dup2(nothing, STDIN_FILENO);
        set_limits(request);
        constexpr std::byte started{1};
        give({&started, 1});
        const oneapi::tbb::global_control few_threads(oneapi::tbb::global_control::max_allowed_parallelism, 4);
        write_result(result_of_reading(request), give);
    } catch (const std::exception&) {
        _exit(1); // there is nobody left to tell
    }
    _exit(0); // without taking down what may be damaged
}
