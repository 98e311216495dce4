#include "scene/cell_shape.h"

namespace visorder {

const char* name(CellShape shape)
{
    return shape_tables::of(shape).name;
}

} // namespace visorder
