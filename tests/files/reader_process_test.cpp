#include "files/reader_process.h"

#include "tests/temporary_folder.h"
#include "visorder/error.h"
#include "visorder/read_mesh.h"

#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <optional>
#include <thread>

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::tests;
using testing::HasSubstr;

namespace {

const TemporaryFolder folder;

/// Has another program do the reading for as long as it lives.
class OtherReader {
public:
    explicit OtherReader(const std::filesystem::path& program) { setenv(name, program.c_str(), 1); }
    ~OtherReader() { unsetenv(name); }
    OtherReader(const OtherReader&) = delete;
    OtherReader& operator=(const OtherReader&) = delete;

private:
    static constexpr const char* name = "VISORDER_READER";
};

/// A program that runs commands of the shell.
std::filesystem::path script(const std::string& commands)
{
    const auto path = folder.write("reader.sh", "#!/bin/sh\n" + commands + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
}

std::filesystem::path two_triangles()
{
    return folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\nl 1 2\n");
}

std::string error_of(const std::filesystem::path& file, const std::optional<ReadingLimits>& limits = {})
{
    try {
        limits ? read_in_own_process(file, {}, *limits) : read_in_own_process(file, {});
    } catch (const InputError& error) {
        const std::string what = error.what(), name = file.string() + ": ";
        EXPECT_TRUE(what.starts_with(name)) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        return what.substr(std::min(what.size(), name.size()));
    }
    return "";
}

std::chrono::duration<double> time_of(const std::function<void()>& action)
{
    const auto begin = std::chrono::steady_clock::now();
    action();
    return std::chrono::steady_clock::now() - begin;
}

} // namespace

TEST(ReaderProcess, GivesWhatReadingHereGives)
{
    const auto path = two_triangles();
    const MeshFile there = read_in_own_process(path, {.weld = true});
    const MeshFile here = read_mesh(path, {.weld = true, .isolated = false});
    EXPECT_EQ(there.mesh.points, here.mesh.points);
    EXPECT_EQ(there.mesh.shapes, here.mesh.shapes);
    EXPECT_EQ(there.mesh.offsets, here.mesh.offsets);
    EXPECT_EQ(there.mesh.vertices, here.mesh.vertices);
    EXPECT_EQ(there.mesh.scalars, here.mesh.scalars);
    EXPECT_EQ(there.scalar, here.scalar);
    EXPECT_EQ(there.notes, here.notes);
    EXPECT_EQ(there.file_cells, here.file_cells);
    EXPECT_EQ(there.notes.size(), 2u);
}

TEST(ReaderProcess, PassesErrorsOn)
{
    EXPECT_EQ(error_of(folder.file("none.obj")), "there is no such file");
    EXPECT_EQ(error_of(folder.write("bad.obj", "v 0 0 zero\n")),
              "line 1: \"zero\" is not a number that can be taken here");
}

TEST(ReaderProcess, SaysThatTheReaderCrashed)
{
    for (const char* signal : {"SEGV", "ABRT", "FPE", "BUS"}) {
        const OtherReader reader(script(fmt::format("printf '\\001'; kill -{} $$", signal)));
        EXPECT_EQ(error_of(two_triangles()), "cannot be read: the reader crashed, so it is damaged") << signal;
    }
    const OtherReader reader(script("printf '\\001'; exit 1")); // as libraries do
    EXPECT_EQ(error_of(two_triangles()), "cannot be read: the reader crashed, so it is damaged");
}

TEST(ReaderProcess, StopsAReaderThatDoesNotEnd)
{
    const ReadingLimits second{std::chrono::seconds(1), 1 << 30};
    for (const char* commands : {"exec sleep 60", "printf '\\001'; exec sleep 60", "printf '\\001'; exec yes"}) {
        const OtherReader reader(script(commands));
        std::string error;
        EXPECT_LT(time_of([&] { error = error_of(two_triangles(), second); }).count(), 30) << commands;
        EXPECT_THAT(error, testing::StartsWith("cannot be read: ")) << commands;
    }
    const OtherReader reader(script("printf '\\001'; exec sleep 60"));
    EXPECT_EQ(error_of(two_triangles(), second), "cannot be read: it takes longer than 1 s");
}

TEST(ReaderProcess, TakesNoAnswerOfAnotherKind)
{
    for (const char* commands :
         {"printf '\\001'", "printf '\\001\\002'", "exec cat", "printf '\\001'; exec head -c 100 /dev/zero",
          "printf '\\001'; head -c 8 /dev/zero; exec yes", "exec yes", "exec echo visorder"}) {
        const OtherReader reader(script(commands));
        EXPECT_NE(error_of(two_triangles(), ReadingLimits{std::chrono::seconds(5), 1 << 30}), "") << commands;
    }
}

TEST(ReaderProcess, SaysThatTheProgramDoesNotStart)
{
    const OtherReader missing(folder.file("missing"));
    EXPECT_THAT(error_of(two_triangles()), HasSubstr("missing cannot be started: No such file"));
    const OtherReader silent("/bin/true");
    EXPECT_EQ(error_of(two_triangles()), "cannot be read: /bin/true does not start");
}

TEST(ReaderProcess, KeepsItsMemoryLimit)
{
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "address space is not limited under the address sanitizer";
#endif
    std::string many_points;
    for (int i = 0; i < 400000; ++i)
        many_points += "v 0 0 1\n";
    const auto path = folder.write("many.obj", many_points + "f 1 2 3\n");
    EXPECT_EQ(error_of(path), "");
    // Reading takes more than what is left of 1 GiB after the program itself; how much that is, limits tell.
    bool refused = false;
    for (std::uint64_t memory = std::uint64_t{1} << 30; memory > 1 << 20 && !refused; memory -= memory / 16)
        refused = error_of(path, ReadingLimits{std::chrono::seconds(20), memory}) ==
                  "cannot be read: it asks for more memory than there is";
    EXPECT_TRUE(refused);
}

TEST(ReaderProcess, AllowsMoreForLargerFiles)
{
    EXPECT_EQ(limits_for(0).time.count(), 15);
    EXPECT_EQ(limits_for(0).memory_bytes, std::uint64_t{4} << 30);
    EXPECT_EQ(limits_for(1'000'000'000).time.count(), 215);
    EXPECT_EQ(limits_for(1'000'000'000).memory_bytes, (std::uint64_t{4} << 30) + 20'000'000'000);
    EXPECT_GT(limits_for(UINT64_MAX).memory_bytes, limits_for(1'000'000'000).memory_bytes);
}

TEST(ReaderProcess, WorksFromManyThreads)
{
    const auto path = two_triangles();
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&] {
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(read_in_own_process(path, {}).mesh.cell_count(), 2u);
        });
    for (std::thread& thread : threads)
        thread.join();
}
