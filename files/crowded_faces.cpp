#include "files/crowded_faces.h"

#include "scene/adjacency.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace visorder::detail {

std::string crowded_faces_note(const Scene& scene, const CellNumbers& cells)
{
    const auto& crowded = scene.adjacency().crowded;
    if (crowded.empty())
        return "";
    // The first face in the caller's numbering.
    std::vector<CellId> first;
    for (const std::vector<CellId>& face : crowded) {
        std::vector<CellId> callers(face.size());
        std::transform(face.begin(), face.end(), callers.begin(),
                       [&](CellId cell) { return scene.caller_cells()[cell]; });
        std::sort(callers.begin(), callers.end());
        if (first.empty() || callers < first)
            first = std::move(callers);
    }
    std::vector<std::string> names;
    for (const CellId cell : first)
        names.push_back(cells.name(cell));
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{} and {} share one face{}; cells overlap there, or one is listed twice",
                       fmt::join(names, ", "), last,
                       crowded.size() == 1 ? "" : fmt::format(", as do others at {} faces more", crowded.size() - 1));
}

} // namespace visorder::detail
