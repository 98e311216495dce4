#pragma once

#include "bench/frames.h"
#include "visorder/mesh.h"
#include "visorder/sorter_options.h"
#include "visorder/sorters.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace visorder::bench {

/// What to compare.
struct ComparisonOptions {
    std::vector<std::filesystem::path> files; ///< meshes to read
    std::vector<std::string> generated;       ///< scenes to make, NAME[:SIZE[:SEED]]
    std::vector<std::string> sorters;         ///< names; empty: all of the build
    int views = 4;                            ///< random views of each scene
    bool hard_views = false;                  ///< and those where orders go wrong first
    glm::ivec2 size{512, 512};                ///< of the views, in pixels
    std::optional<glm::dvec3> up;             ///< in the views; none: what suits each scene
    std::uint64_t seed = 1;                   ///< of the views
    int repeats = 5;                          ///< timed sorts a view, of which the median counts
    bool subdivide = true;                    ///< mixed-element cells into tetrahedra
    bool weld = false;                        ///< points of files with exactly equal coordinates, or
    double weld_tolerance = 0;                ///< within this distance of each other
    std::string scalar;                       ///< of files; empty: the format's default
    std::string time;                         ///< of files, as in ReadOptions
    std::size_t audit_rays = 0;               ///< from each view, that orders are held against; 0: none
    SorterOptions sorter_options;
    int frames = 1; ///< views from which the scene is drawn in every order, where it can be drawn and has no more than
    std::size_t frames_up_to = 500'000; ///< cells, for what can take minutes beyond
    std::filesystem::path images;       ///< a folder to keep frames in, of any number of cells; empty: none
};

/// A scene as the result format has it.
struct SceneResult {
    std::string name;
    std::size_t cells;
    std::size_t boundary_faces;
    bool convex;
    bool delaunay;
    std::size_t overlapping_pairs; ///< of cells; in no order, and in no count of relations
    std::vector<std::string> notes;
    bool surface = false;                      ///< of triangles, whose boundary faces are edges
    std::vector<IntegratorResult> integrators; ///< against the ray caster, from the first view; empty where none drew
};

/// One sorter on one view of one scene. Image errors are against the frame in an exact order; none where no frames were
/// drawn or no such order is known.
struct RunResult {
    std::string scene;
    int view;
    std::string view_name;
    std::string sorter;
    Guarantee guarantee{};
    double prepare_s = 0;
    double sort_s = 0;
    std::size_t structure_bytes = 0;
    std::size_t relations = 0;
    std::size_t violations = 0;           ///< outside of cycles
    std::size_t violations_in_cycles = 0; ///< of relations that no order can satisfy all of
    std::size_t cycles = 0;
    std::size_t cells_in_cycles = 0;
    std::size_t audit_rays = 0;
    std::size_t audit_pairs = 0;      ///< that they show, of cells behind each other (see RayAudit)
    std::size_t audit_violations = 0; ///< distinct ones that the order has the wrong way round, outside of cycles
    std::optional<double> image_rmse;
    std::optional<double> image_max;
    std::vector<Statistic> statistics; ///< of the last sort
    std::string skipped;               ///< why, where the sorter cannot take the scene; nothing else is measured then

    /// Whether the sorter broke its promise.
    bool failed() const
    {
        return skipped.empty() && guarantee != Guarantee::approximate && violations + audit_violations > 0;
    }
};

/// A file or generated scene that could not be compared on.
struct Refusal {
    std::string source;
    std::string reason; ///< one line, which names the source
};

struct Comparison {
    std::vector<SceneResult> scenes;
    std::vector<RunResult> runs;  ///< scene by scene, sorter by sorter, view by view
    std::string gl_renderer;      ///< that drew frames; empty if none did
    std::vector<Refusal> refused; ///< in the order of the sources

    bool failed() const;
};

/// Runs every sorter on every scene from every view: times it, and holds its orders against all relations and, if asked
/// to, against rays. Scenes are
/// made one after another and released. Frames are drawn apart from the timed sorts. `progress` is told in a few words
/// what is being done. A file or a scene that cannot be taken is among `refused`, and the others are compared on
/// nevertheless. Throws InputError for a sorter that there is not.
Comparison compare(const ComparisonOptions& options, const std::function<void(const std::string&)>& progress);

} // namespace visorder::bench
