#include "visorder/error.h"
#include "vtk/xml_check.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        visorder::detail::check_xml_content({reinterpret_cast<const char*>(data), size});
    } catch (const visorder::InputError&) {
        // Damaged, and said to be.
    }
    return 0;
}
