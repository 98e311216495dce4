// Reads orders, as text and as NumPy arrays.

#include "apps/order_file.h"
#include "tests/fuzz/fuzzed_file.h"
#include "visorder/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    for (const char* name : {"order.txt", "order.npy"})
        try {
            visorder::apps::read_order(visorder::tests::fuzzed_file(name, data, size));
        } catch (const visorder::InputError&) {
            // Damaged, and said to be.
        }
    return 0;
}
