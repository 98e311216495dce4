#include "files/reader_process.h"

#include "files/mesh_file_bytes.h"
#include "reader_folders.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <poll.h>
#include <span>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace visorder::detail {

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const std::string& what)
{
    throw InputError("cannot be read: " + what);
}

[[noreturn]] void fail_of_system(const char* what)
{
    fail(fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number)
    {
        // Beyond those that the new process gives another meaning to.
        if (number >= 0 && number < first_free) {
            number_ = fcntl(number, F_DUPFD_CLOEXEC, first_free);
            ::close(number);
        }
        if (number_ < 0)
            fail_of_system("no file for the reader");
    }
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor& operator=(Descriptor&&) = delete;

    int number() const { return number_; }
    void close()
    {
        if (number_ >= 0)
            ::close(std::exchange(number_, -1));
    }

private:
    static constexpr int first_free = 10;
    int number_;
};

struct Pipe {
    Descriptor read_end;
    Descriptor write_end;
};

Pipe new_pipe()
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        fail_of_system("no pipe to the reader");
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

class SpawnActions {
public:
    SpawnActions() { posix_spawn_file_actions_init(&actions_); }
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;

    posix_spawn_file_actions_t* get() { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

// What is thrown where there is no more to read, and where there is no more time.
struct Ended {};
struct TooLate {};

/// A process of visorder-read. It is dead and gone when this is.
class ReaderProcess {
public:
    ReaderProcess(const std::filesystem::path& program, Clock::time_point deadline)
        : request_(new_pipe()), result_(new_pipe()), deadline_(deadline)
    {
        SpawnActions actions;
        posix_spawn_file_actions_adddup2(actions.get(), request_.read_end.number(), STDIN_FILENO);
        posix_spawn_file_actions_adddup2(actions.get(), result_.write_end.number(), STDOUT_FILENO);
        posix_spawn_file_actions_addopen(actions.get(), STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addclosefrom_np(actions.get(), STDERR_FILENO + 1);
        std::string name = program.string();
        std::array arguments{name.data(), static_cast<char*>(nullptr)};
        const int error = posix_spawn(&id_, name.c_str(), actions.get(), nullptr, arguments.data(), environ);
        if (error != 0)
            fail(fmt::format("{} cannot be started: {}", name, std::generic_category().message(error)));
        result_.write_end.close();                               // so that reading notices when the process has ended
        fcntl(result_.read_end.number(), F_SETPIPE_SZ, 1 << 20); // fewer turns; any size will do
    }
    ~ReaderProcess()
    {
        kill(id_, SIGKILL);
        wait();
    }
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    /// Gives it a few bytes.
    void write(std::span<const std::byte> bytes) const
    {
        // Our read end is still open, so no signal comes of it, and a pipe holds that much at once.
        if (::write(request_.write_end.number(), bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            fail_of_system("the reader cannot be asked");
    }

    /// Takes bytes from it. Throws Ended where it ends before it has given them, TooLate at the deadline.
    void read(std::span<std::byte> bytes) const
    {
        while (!bytes.empty()) {
            wait_for_bytes();
            const ssize_t n = ::read(result_.read_end.number(), bytes.data(), bytes.size());
            if (n == 0)
                throw Ended();
            if (n < 0 && errno != EINTR)
                fail_of_system("the reader's answer is lost");
            bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
        }
    }

    /// Waits for its end, and returns how it ended, as waitpid does; nothing if the caller's program looks after that.
    std::optional<int> wait()
    {
        if (!waited_) {
            waited_ = true;
            int status = 0;
            pid_t ended = 0;
            do
                ended = waitpid(id_, &status, 0);
            while (ended < 0 && errno == EINTR);
            if (ended == id_)
                status_ = status;
        }
        return status_;
    }

private:
    void wait_for_bytes() const
    {
        while (true) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
            if (left <= 0)
                throw TooLate();
            pollfd entry{result_.read_end.number(), POLLIN, 0};
            constexpr long an_hour = 3'600'000; // poll counts in int
            if (poll(&entry, 1, static_cast<int>(std::min(left, an_hour))) > 0)
                return;
        }
    }

    Pipe request_;
    Pipe result_;
    Clock::time_point deadline_;
    pid_t id_ = 0;
    bool waited_ = false;
    std::optional<int> status_;
};

/// Why there is no result.
std::string reason(const std::optional<int>& status)
{
    if (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGXCPU)
        return "it takes too long";
    if (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGKILL)
        return "the reader was stopped from outside, perhaps for want of memory";
    return "the reader crashed, so it is damaged";
}

/// Text from a process that may have been upset, as one line.
std::string one_line(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, '?');
    return text;
}

MeshFile run_reader_program(const std::filesystem::path& file, const ReadOptions& options, const ReadingLimits& limits)
{
    const std::filesystem::path program = reader_program();
    if (program.empty())
        fail("there is no program visorder-read to read it with; VISORDER_READER can name it");

    ReadRequest request{file.string(), options, limits.memory_bytes, static_cast<std::uint64_t>(limits.time.count())};
    request.options.isolated = false;
    ReaderProcess process(program, Clock::now() + limits.time);
    bool started = false;
    try {
        write_request(request, [&](std::span<const std::byte> bytes) { process.write(bytes); });
        std::byte first{};
        process.read({&first, 1});
        started = true;
        ReadResult result = read_result([&](std::span<std::byte> bytes) { process.read(bytes); }, limits.memory_bytes);
        if (auto* error = std::get_if<std::string>(&result))
            throw InputError(one_line(*error));
        auto& mesh = std::get<MeshFile>(result);
        for (std::string& note : mesh.notes)
            note = one_line(note);
        return std::move(mesh);
    } catch (const TooLate&) {
        fail(fmt::format("it takes longer than {} s", limits.time.count()));
    } catch (const Ended&) {
        fail(started ? reason(process.wait()) : fmt::format("{} does not start", program.string()));
    }
}

} // namespace

ReadingLimits limits_for(std::uint64_t file_bytes)
{
    constexpr std::uint64_t gibibyte = std::uint64_t{1} << 30;
    constexpr std::uint64_t bytes_per_second = 5'000'000;
    const std::uint64_t bytes = std::min(file_bytes, std::uint64_t{1} << 50); // so that nothing overflows
    return {std::chrono::seconds(15 + bytes / bytes_per_second), 4 * gibibyte + 20 * bytes};
}

std::filesystem::path reader_program()
{
    if (const char* named = std::getenv("VISORDER_READER"); named && *named)
        return named;

    std::error_code error;
    std::vector<std::filesystem::path> folders;
    const auto beside = [&](const std::filesystem::path& program) {
        if (program.is_absolute())
            folders.insert(folders.end(), {program.parent_path(), program.parent_path() / "../libexec/visorder"});
    };
    beside(std::filesystem::read_symlink("/proc/self/exe", error));
    // The library may be part of a shared object, such as a module of Python.
    if (Dl_info object{}; dladdr(reinterpret_cast<const void*>(&reader_program), &object) != 0 && object.dli_fname)
        beside(object.dli_fname);
    folders.emplace_back(built_reader_folder);
    folders.emplace_back(installed_reader_folder);
    for (const std::filesystem::path& folder : folders)
        if (auto program = folder / "visorder-read"; access(program.c_str(), X_OK) == 0)
            return program;
    return {};
}

MeshFile read_in_own_process(const std::filesystem::path& file, const ReadOptions& options)
{
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    return read_in_own_process(file, options, limits_for(error ? 0 : size));
}

MeshFile read_in_own_process(const std::filesystem::path& file, const ReadOptions& options, const ReadingLimits& limits)
{
    try {
        return run_reader_program(file, options, limits);
    } catch (const InputError& error) {
        // What the other process says names the file, as all readers do.
        const std::string what = error.what(), name = file.string() + ": ";
        throw InputError(what.starts_with(name) ? what : name + what);
    }
}

} // namespace visorder::detail
