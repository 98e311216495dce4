#include "tests/fuzz/fuzzed_file.h"
#include "visorder/error.h"
#include "vtk/netcdf_length.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        visorder::detail::declared_netcdf_length(visorder::tests::fuzzed_file("mesh.e", data, size));
    } catch (const visorder::InputError&) {
        // Damaged, and said to be.
    }
    return 0;
}
