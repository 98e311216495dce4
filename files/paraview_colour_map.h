#pragma once

#include "files/transfer_function_file.h"
#include "visorder/transfer_function.h"

#include <nlohmann/json_fwd.hpp>

namespace visorder::detail {

/// One of ParaView's colour maps: see transfer_function_file.h. Throws InputError without the file's name.
TransferFunction transfer_function_of_paraview(const nlohmann::json& map, const TransferFunctionFileOptions& options);

} // namespace visorder::detail
