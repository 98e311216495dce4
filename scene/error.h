#pragma once

#include <stdexcept>

namespace visorder {

/// What is thrown for input that cannot be taken: a mesh, view, file or option. One line that names the cell, the
/// point, the file or the option at fault; the command line prints it and exits with 2.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace visorder
