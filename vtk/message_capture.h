#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace visorder::detail {

/// Runs a VTK reader. Throws InputError, naming the file, with the first error that VTK reports, and with the first
/// warning that comes from no object (which is how the legacy readers report damage); returns all other warnings, one
/// line each.
///
/// VTK reports to one window and one log for the whole process: both are silenced meanwhile, and put back after. One
/// run at a time; others wait.
std::vector<std::string> run_reader(const std::filesystem::path& file, const std::function<void()>& read);

} // namespace visorder::detail
