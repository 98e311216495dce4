#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace visorder::tests {

/// A small valid file.
struct Seed {
    std::string name;    ///< of the file, whose ending tells the format
    std::string content; ///< its bytes
};

/// Files of the formats that VTK reads, in their encodings and compressions: in a build with VTK.
std::vector<Seed> vtk_seeds();

/// Files of the formats that visorder reads itself.
std::vector<Seed> own_seeds();

/// The seeds whose names have this ending.
std::vector<Seed> seeds_of(const std::string& ending);

} // namespace visorder::tests
