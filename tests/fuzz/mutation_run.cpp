// visorder_mutation_run ENDING NUMBER [FIRST [FOLDER]]: reads NUMBER damaged files of a format, from mutation FIRST on,
// and counts what comes of it. Files are read within processes that read many (not isolated), so that all faults of the
// readers show. Seeds are our own, and the files of FOLDER with that ending. Inputs that end a process or do not end
// are left in the working folder. Exits with 1 if there are any.

#include "files/transfer_function_file.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/seeds.h"
#include "tests/temporary_folder.h"
#include "visorder/error.h"
#include "visorder/read_mesh.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <new>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::tests;

enum Outcome : std::size_t { read, refused, out_of_memory, outcomes };

/// What a worker and the process that looks after it share.
struct Progress {
    std::atomic<std::uint64_t> at;
    std::array<std::atomic<std::uint64_t>, outcomes> counts;
};

class Run {
public:
    Run(std::string ending, std::uint64_t first, std::uint64_t end, std::vector<std::string> contents)
        : ending_(std::move(ending)),
          first_(first),
          end_(end),
          contents_(std::move(contents)),
          path_(folder_.file("mesh" + ending_))
    {
        void* shared = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        progress_ = new (shared) Progress();
    }

    int run()
    {
        progress_->at = first_;
        while (progress_->at < end_)
            // What a reader has damaged may end the process much later: only what fails in a new one counts.
            if (const std::string failure = run_worker(1000); !failure.empty()) {
                if (const std::string again = run_worker(1); !again.empty())
                    fail(again);
                else
                    ++late_;
            }
        fmt::print("{}: {} inputs: {} read, {} refused, {} out of memory", ending_, end_ - first_,
                   progress_->counts[read].load(), progress_->counts[refused].load(),
                   progress_->counts[out_of_memory].load());
        for (const auto& [how, count] : failures_)
            fmt::print(", {} {}", count, how);
        fmt::print(", {} processes ended by earlier damage\n", late_);
        return failures_.empty() ? 0 : 1;
    }

private:
    /// A process that reads that many files, or until one of them ends it: how, if so.
    std::string run_worker(int files)
    {
        const pid_t worker = fork();
        if (worker == 0) {
            work(files);
            _exit(0);
        }
        std::uint64_t last = progress_->at;
        auto since = std::chrono::steady_clock::now();
        int status = 0;
        while (waitpid(worker, &status, WNOHANG) == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            if (const std::uint64_t at = progress_->at; at != last) {
                last = at;
                since = std::chrono::steady_clock::now();
            } else if (std::chrono::steady_clock::now() - since > std::chrono::seconds(20)) {
                kill(worker, SIGKILL);
                waitpid(worker, &status, 0);
                return "hang";
            }
        }
        if (WIFSIGNALED(status))
            return fmt::format("signal{}", WTERMSIG(status));
        return WEXITSTATUS(status) == 0 ? "" : fmt::format("exit{}", WEXITSTATUS(status));
    }

    void fail(const std::string& how)
    {
        ++failures_[how];
        const std::uint64_t number = progress_->at++;
        const std::string file = fmt::format("{}_{}{}", how, number, ending_);
        std::ofstream(file, std::ios::binary) << mutated(contents_, number);
        fmt::print("{}\n", file);
        std::fflush(stdout);
    }

    void work(int files)
    {
        const int nothing = open("/dev/null", O_WRONLY);
        dup2(nothing, STDOUT_FILENO);
        dup2(nothing, STDERR_FILENO);
#if !defined(__SANITIZE_ADDRESS__)
        const rlimit memory{rlim_t{4} << 30, rlim_t{4} << 30};
        setrlimit(RLIMIT_AS, &memory);
#endif
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        for (int left = files; left > 0 && progress_->at < end_; --left) {
            const std::string content = mutated(contents_, progress_->at);
            std::ofstream(path_, std::ios::binary) << content;
            ++progress_->counts[outcome_of_reading()];
            ++progress_->at;
        }
    }

    Outcome outcome_of_reading() const
    {
        try {
            if (ending_ == ".json")
                read_transfer_function(path_);
            else
                read_mesh(path_, {.isolated = false});
            return read;
        } catch (const InputError&) {
            return refused;
        } catch (const std::bad_alloc&) {
            return out_of_memory;
        }
    }

    std::string ending_;
    std::uint64_t first_;
    std::uint64_t end_;
    std::vector<std::string> contents_;
    TemporaryFolder folder_;
    std::filesystem::path path_;
    Progress* progress_ = nullptr;
    std::map<std::string, int> failures_;
    int late_ = 0;
};

} // namespace

int main(int argc, char** argv)
{
    if (argc < 3) {
        fmt::print(stderr, "usage: visorder_mutation_run ENDING NUMBER [FIRST [FOLDER]]\n");
        return 2;
    }
    const std::string ending = argv[1];
    const std::uint64_t first = argc > 3 ? std::stoull(argv[3]) : 0;
    std::vector<std::string> contents;
    for (const Seed& seed : seeds_of(ending))
        contents.push_back(seed.content);
    if (argc > 4)
        for (const auto& entry : std::filesystem::directory_iterator(argv[4]))
            if (entry.path().string().ends_with(ending) && entry.file_size() < 100'000)
                contents.push_back(content_of(entry.path()));
    if (contents.empty()) {
        fmt::print(stderr, "visorder_mutation_run: there is no seed for {}\n", ending);
        return 2;
    }
    return Run(ending, first, first + std::stoull(argv[2]), std::move(contents)).run();
}
