#include "files/cell_numbers.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <utility>

namespace visorder::detail {

CellNumbers::CellNumbers(std::vector<std::uint64_t> file_cells, std::vector<MeshBlock> blocks)
    : file_cells_(std::move(file_cells)),
      blocks_(std::move(blocks)),
      whole_(std::adjacent_find(file_cells_.begin(), file_cells_.end(), std::greater_equal<>()) == file_cells_.end())
{
}

std::vector<std::uint64_t> CellNumbers::numbers(std::span<const CellId> cells) const
{
    std::vector<std::uint64_t> result(cells.size());
    std::transform(cells.begin(), cells.end(), result.begin(), [this](CellId cell) { return number(cell); });
    return result;
}

std::vector<CellId> CellNumbers::cells(std::span<const std::uint64_t> numbers) const
{
    std::vector<CellId> result;
    result.reserve(numbers.size());
    std::vector<bool> listed(file_cells_.size());
    for (const std::uint64_t number : numbers) {
        std::uint64_t cell = number;
        if (whole_)
            cell = static_cast<std::uint64_t>(std::lower_bound(file_cells_.begin(), file_cells_.end(), number) -
                                              file_cells_.begin());
        if (cell >= file_cells_.size() || (whole_ && file_cells_[cell] != number))
            throw InputError(
                file_cells_.empty() || !whole_ || file_cells_.back() + 1 == file_cells_.size()
                    ? fmt::format("the order lists cell {}, but there are {} cells", number, file_cells_.size())
                    : fmt::format("the order lists cell {}, which is none of the {} cells taken of the file, {} to {}",
                                  number, file_cells_.size(), file_cells_.front(), file_cells_.back()));
        if (listed[cell])
            throw InputError(fmt::format("the order lists cell {} twice", number));
        listed[cell] = true;
        result.push_back(static_cast<CellId>(cell));
    }
    if (result.size() < file_cells_.size()) {
        const auto missing = std::find(listed.begin(), listed.end(), false) - listed.begin();
        throw InputError(fmt::format("the order leaves out {}", name(static_cast<CellId>(missing))));
    }
    return result;
}

std::string CellNumbers::name(CellId cell) const
{
    if (cell >= file_cells_.size())
        return fmt::format("cell {}", cell);
    const std::uint64_t file_cell = file_cells_[cell];
    const std::string block = block_of(file_cell);
    if (!whole_)
        return fmt::format("part {} (of cell {}{}{})", cell, file_cell, block.empty() ? "" : ", ", block);
    return block.empty() ? fmt::format("cell {}", file_cell) : fmt::format("cell {} ({})", file_cell, block);
}

std::string CellNumbers::block_of(std::uint64_t file_cell) const
{
    const auto after =
        std::upper_bound(blocks_.begin(), blocks_.end(), file_cell,
                         [](std::uint64_t number, const MeshBlock& block) { return number < block.first_file_cell; });
    if (after == blocks_.begin())
        return "";
    const MeshBlock& block = *(after - 1);
    return fmt::format("block '{}', its cell {}", block.name, file_cell - block.first_file_cell);
}

CellNumbers cell_numbers(const MeshFile& file)
{
    if (!file.file_cells.empty())
        return {file.file_cells, file.blocks};
    std::vector<std::uint64_t> all(file.mesh.cell_count());
    std::iota(all.begin(), all.end(), std::uint64_t{0});
    return {std::move(all), file.blocks};
}

CellNumbers cell_numbers(const MeshFile& file, std::span<const CellId> cell_of)
{
    std::vector<std::uint64_t> of_parts(cell_of.size());
    std::transform(cell_of.begin(), cell_of.end(), of_parts.begin(),
                   [&](CellId cell) { return file.file_cells.empty() ? cell : file.file_cells[cell]; });
    return {std::move(of_parts), file.blocks};
}

} // namespace visorder::detail
