#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace visorder {

/// What is thrown for input that cannot be taken: a mesh, view, file or option. One line that names the cell, the
/// point, the file or the option at fault; the command line prints it and exits with 2.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An InputError about one cell, in the numbering of the mesh that was given: "cell 5: FAULT". Who knows the cell by
/// another number, as that in a file, can put it in its place.
class CellError : public InputError {
public:
    CellError(std::size_t cell, const std::string& fault)
        : InputError("cell " + std::to_string(cell) + ": " + fault), cell_(cell), fault_(fault)
    {
    }
    std::size_t cell() const { return cell_; }
    const std::string& fault() const { return fault_; }

private:
    std::size_t cell_;
    std::string fault_;
};

/// OpenGL is not there, is not enough, or reported an error. The message names the renderer where there is one.
class GraphicsError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace visorder
