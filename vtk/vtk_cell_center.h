#pragma once

#include "visorder/sorter.h"

#include <memory>
#include <vector>

namespace visorder::detail {

/// VTK's vtkCellCenterDepthSort (Moreland, 2003), as a peer to compare with: the cells by the depth of their centres
/// along the direction of projection, in single precision. VTK gets the cells and points in the caller's numbering, as
/// a VTK user has them, and keeps the centres from the first sort on.
///
/// Approximate, on any scene. One `sort` at a time on one sorter; any number of sorters on one Scene.
class VtkCellCenter final : public Sorter {
public:
    explicit VtkCellCenter(const Scene& scene);
    ~VtkCellCenter() override;

    Guarantee guarantee() const override { return Guarantee::approximate; }

    /// The direction of projection of a perspective view is that of `world_to_clip`; if that shows none (it is no
    /// perspective matrix), from the eye to the middle of the scene. Throws std::runtime_error if VTK does not return
    /// every cell once.
    void sort(const View& view, Order& order) override;

    /// The grid that VTK holds, as VTK counts it.
    std::size_t bytes() const override;

private:
    struct Vtk;
    std::unique_ptr<Vtk> vtk_;
    glm::dvec3 middle_;
    double radius_; ///< of a sphere around the scene
    std::vector<bool> returned_;
};

} // namespace visorder::detail
