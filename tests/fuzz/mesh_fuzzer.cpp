// Reads meshes in one of the formats that visorder reads itself, of the ending VISORDER_FUZZ_ENDING.

#include "visorder/error.h"
#include "visorder/read_mesh.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::filesystem::path name = std::string("/nowhere/mesh") + VISORDER_FUZZ_ENDING;
    try {
        visorder::read_mesh_content(name, {reinterpret_cast<const char*>(data), size});
    } catch (const visorder::InputError&) {
        // Damaged, and said to be.
    }
    return 0;
}
