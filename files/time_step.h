#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace visorder::detail {

/// Which of a file's time steps is wanted: "first", "last" or nothing (the last), "index:N" counted from 0, or a time.
/// Of several steps of one time the first. Adds a note that tells which, if there are several. 0 for a file without
/// steps. Throws InputError, naming the file, where there is no such step, with the times that there are.
std::size_t choose_time_step(const std::filesystem::path& path, std::span<const double> times,
                             const std::string& wanted, std::vector<std::string>& notes);

} // namespace visorder::detail
