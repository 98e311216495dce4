// visorder_write_seeds FOLDER: writes our seeds there, into a folder for each ending.

#include "tests/fuzz/seeds.h"

#include <fmt/format.h>
#include <fstream>

int main(int argc, char** argv)
{
    if (argc != 2) {
        fmt::print(stderr, "usage: visorder_write_seeds FOLDER\n");
        return 2;
    }
    for (const visorder::tests::Seed& seed : visorder::tests::seeds_of("")) {
        const std::string ending = seed.name.substr(seed.name.find_last_of('.') + 1);
        const auto folder = std::filesystem::path(argv[1]) / (seed.name.ends_with("xyz.bin") ? "xyz.bin" : ending);
        std::filesystem::create_directories(folder);
        std::ofstream(folder / seed.name, std::ios::binary) << seed.content;
    }
    return 0;
}
