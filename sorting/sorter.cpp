#include "sorting/sorter.h"

namespace visorder {

const char* name(Guarantee guarantee)
{
    return guarantee == Guarantee::exact ? "exact" : "approximate";
}

} // namespace visorder
