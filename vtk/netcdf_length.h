#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace visorder::detail {

/// The bytes that a file of one of netCDF's classic formats (CDF-1, -2 and -5) must have to hold the variables that its
/// header declares; nothing for any other file, among them netCDF-4 files, whose library notices missing bytes itself.
/// Throws InputError, naming the file, where the header is cut short or makes no sense.
std::optional<std::uint64_t> declared_netcdf_length(const std::filesystem::path& path);

} // namespace visorder::detail
