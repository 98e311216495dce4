#include "files/transfer_function_file.h"
#include "tests/fuzz/fuzzed_file.h"
#include "visorder/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        visorder::detail::read_transfer_function(visorder::tests::fuzzed_file("map.json", data, size));
    } catch (const visorder::InputError&) {
        // Damaged, and said to be.
    }
    return 0;
}
