#pragma once

#include "visorder/read_mesh.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace visorder::detail {

// What passes between a program that reads a mesh and the process that does it for it (see reader_process.h), as bytes
// of this machine's layout. The fields of each struct are listed once, in mesh_file_bytes.cpp.

/// What is to be read, and within which limits.
struct ReadRequest {
    std::string file;
    ReadOptions options;
    std::uint64_t memory_bytes = 0;
    std::uint64_t processor_seconds = 0;
};

/// A mesh, or the message of the InputError that reading it ended with.
using ReadResult = std::variant<MeshFile, std::string>;

/// Takes or gives bytes, all of them, or throws.
using WriteBytes = std::function<void(std::span<const std::byte>)>;
using ReadBytes = std::function<void(std::span<std::byte>)>;

// Reading throws InputError for bytes of any other layout, and where they say that there are more than `most_bytes`.
// What is in a mesh is not checked (see `validate`).

void write_request(ReadRequest request, const WriteBytes& write);
ReadRequest read_request(const ReadBytes& read);

void write_result(ReadResult&& result, const WriteBytes& write);
ReadResult read_result(const ReadBytes& read, std::uint64_t most_bytes);

} // namespace visorder::detail
