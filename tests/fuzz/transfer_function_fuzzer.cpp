#include "projection/transfer_function_file.h"
#include "scene/error.h"
#include "tests/fuzz/fuzzed_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        visorder::read_transfer_function(visorder::tests::fuzzed_file("map.json", data, size));
    } catch (const visorder::InputError&) {
        // Damaged, and said to be.
    }
    return 0;
}
