#pragma once

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace visorder::apps {

// Files that the command line names to write to. "-" is standard output.

/// Writes a whole file, or leaves what was there: the text goes to a file beside it, which then takes its place and its
/// mode. A link stays, and what it leads to is written; so do devices, pipes, standard output by any name, and files
/// that have other names too, which are written to as they are. Throws InputError, naming the file, where it cannot be
/// written.
void write_file(const std::filesystem::path& file, std::string_view text);

/// Throws InputError, naming the file, where `write_file` could not write it now. Changes nothing.
void require_writable(const std::filesystem::path& file);

/// Makes the folder, if it is not there. Throws InputError, naming it, where it cannot be made or written to.
void require_writable_folder(const std::filesystem::path& folder);

/// Whether what is written there goes to standard output: "-", /dev/stdout and the like.
bool is_standard_output(const std::filesystem::path& file);

/// Where messages go beside these outputs: standard error if one of them is standard output.
std::FILE* message_stream(std::initializer_list<std::filesystem::path> outputs);

/// The ending of a file's name, with its dot, in small letters.
std::string small_ending(const std::filesystem::path& file);

} // namespace visorder::apps
