#include "tests/fuzz/seeds.h"

namespace visorder::tests {

std::vector<Seed> seeds_of(const std::string& ending)
{
    std::vector<Seed> seeds = own_seeds();
#if defined(VISORDER_WITH_VTK)
    for (Seed& seed : vtk_seeds())
        seeds.push_back(std::move(seed));
#endif
    std::erase_if(seeds, [&](const Seed& seed) { return !seed.name.ends_with(ending); });
    return seeds;
}

} // namespace visorder::tests
