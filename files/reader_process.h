#pragma once

#include "visorder/read_mesh.h"

#include <chrono>
#include <cstdint>
#include <filesystem>

namespace visorder::detail {

// Readers that are not ours may crash on a damaged file, run without end, or ask for any amount of memory. They run in
// a process of their own, of the program visorder-read, with limits on time and memory; arrays come back through a
// pipe. A new program, rather than a copy of the calling process (fork): that may have threads,
// whose locks a copy would find held for ever, and memory that would count towards the limit.

struct ReadingLimits {
    std::chrono::seconds time;
    std::uint64_t memory_bytes; ///< of address space
};

/// What reading a file of that many bytes may take: 15 s and another for every 5 MB; 4 GiB and twenty times its size.
ReadingLimits limits_for(std::uint64_t file_bytes);

/// Where visorder-read is: what the environment variable VISORDER_READER names; else beside the running program, in
/// ../libexec/visorder from there, where the library was built, or where it was to be installed. Empty if nowhere.
std::filesystem::path reader_program();

/// `read_mesh` in a process of its own. Throws InputError, naming the file: what that process threw, that it crashed or
/// reached a limit, or that it could not be started. The mesh is what came back, unchecked. Thread-safe; the process
/// ends with this call, and with the calling thread.
MeshFile read_in_own_process(const std::filesystem::path& file, const ReadOptions& options);
/// The same, within other limits.
MeshFile read_in_own_process(const std::filesystem::path& file, const ReadOptions& options,
                             const ReadingLimits& limits);

} // namespace visorder::detail
