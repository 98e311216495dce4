#include "visorder/sorter.h"

#include <fmt/format.h>

namespace visorder {

const char* name(Guarantee guarantee)
{
    switch (guarantee) {
    case Guarantee::exact:
        return "exact";
    case Guarantee::exact_but_for_overlaps:
        return "exact but";
    case Guarantee::approximate:
        return "approximate";
    }
    return "";
}

std::string describe(Guarantee guarantee, std::size_t overlapping_pairs)
{
    if (guarantee != Guarantee::exact_but_for_overlaps)
        return name(guarantee);
    return fmt::format("exact but for {} overlapping pair{}", overlapping_pairs, overlapping_pairs == 1 ? "" : "s");
}

std::string describe(Guarantee guarantee, const Scene& scene)
{
    return describe(guarantee, guarantee == Guarantee::exact_but_for_overlaps ? scene.overlapping_cells().size() : 0);
}

Guarantee exact_up_to_overlaps(const Scene& scene)
{
    return scene.overlapping_cells().empty() ? Guarantee::exact : Guarantee::exact_but_for_overlaps;
}

} // namespace visorder
