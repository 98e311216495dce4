#include "visorder/checking.h"

#include "checking/audit_rays.h"
#include "checking/convex_body.h"
#include "checking/order_positions.h"
#include "checking/planar_faces.h"
#include "checking/ray_sequence.h"
#include "parallel/large_array.h"
#include "sorting/strongly_connected.h"
#include "visorder/relation.h"

#include <algorithm>
#include <map>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/parallel_sort.h>
#include <utility>

namespace visorder {

using namespace detail;

namespace {

// What a number of rays say of an order, in the inner numbering.
struct Findings {
    std::size_t pairs = 0;
    std::size_t overlapping = 0;
    std::map<std::pair<CellId, CellId>, std::size_t> wrong; // front and back, and the first ray that shows it

    void add(const Findings& other)
    {
        pairs += other.pairs;
        overlapping += other.overlapping;
        for (const auto& [pair, ray] : other.wrong)
            keep(pair, ray);
    }
    void keep(std::pair<CellId, CellId> pair, std::size_t ray)
    {
        const auto [at, is_new] = wrong.try_emplace(pair, ray);
        if (!is_new)
            at->second = std::min(at->second, ray);
    }
};

void look_along(const RaySequence& sequence, std::size_t ray, const LargeArray<std::uint32_t>& place,
                Findings& findings)
{
    const std::size_t n = sequence.cells.size();
    bool descends = true;
    for (std::size_t i = 0; i < n; ++i) {
        findings.pairs += n - sequence.behind[i];
        findings.overlapping += sequence.behind[i] - i - 1;
        descends = descends && (i == 0 || place[sequence.cells[i - 1]] > place[sequence.cells[i]]);
    }
    for (std::size_t i = 0; i < n && !descends; ++i)
        for (std::size_t j = sequence.behind[i]; j < n; ++j)
            if (place[sequence.cells[i]] < place[sequence.cells[j]])
                findings.keep({sequence.cells[i], sequence.cells[j]}, ray);
}

// Whether two cells overlap in space, or two triangles cross as seen from the eye, anywhere: they may lie apart on some
// rays, either way round.
bool have_no_order(const RayTracer& tracer, CellId a, CellId b)
{
    const ConvexBody of_a = body_of(tracer.scene().mesh(), a), of_b = body_of(tracer.scene().mesh(), b);
    return occludes(of_a, of_b, tracer.eye()) && occludes(of_b, of_a, tracer.eye());
}

} // namespace

struct detail::AuditedRays {
    RayTracer tracer;
    std::vector<glm::dvec3> through;
    std::vector<RaySequence> sequences;
};

namespace {

// Of every cell, the set that it is in, by number; of cells that are in none, a number of their own.
std::vector<std::uint32_t> sets_without_order(const AuditedRays& rays, std::span<const std::vector<CellId>> cycles)
{
    const Scene& scene = rays.tracer.scene();
    std::vector<Relation> seen;
    // What is behind a cell and not behind what is: the rest follows from that.
    for (const RaySequence& sequence : rays.sequences)
        for (std::size_t i = 0; i < sequence.cells.size(); ++i) {
            const std::size_t first = sequence.behind[i];
            const std::size_t last = first < sequence.cells.size() ? sequence.behind[first] : first;
            for (std::size_t j = first; j < last; ++j)
                seen.push_back({sequence.cells[i], sequence.cells[j]});
        }
    oneapi::tbb::parallel_sort(seen);
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    std::vector<std::uint8_t> counts(seen.size());
    oneapi::tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
        counts[i] = have_no_order(rays.tracer, seen[i].front, seen[i].back) ? 0 : 1;
    });

    std::vector<std::uint32_t> from, to;
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (counts[i] != 0) {
            from.push_back(seen[i].front);
            to.push_back(seen[i].back);
        }
    std::vector<CellId> inner_cells(scene.cell_count());
    for (CellId cell = 0; cell < scene.cell_count(); ++cell)
        inner_cells[scene.caller_cells()[cell]] = cell;
    for (const std::vector<CellId>& cycle : cycles)
        for (std::size_t i = 0; i < cycle.size(); ++i) {
            from.push_back(inner_cells[cycle[i]]);
            to.push_back(inner_cells[cycle[(i + 1) % cycle.size()]]);
        }
    return strongly_connected_components(graph_of(scene.cell_count(), from, to)).of_node;
}

} // namespace

RayAudit::RayAudit(const Scene& scene, const glm::dvec4& eye, const RayAuditOptions& options)
{
    validate(View{eye, glm::dmat4(1), glm::ivec2(1)});
    require_planar_faces(scene);
    auto rays = std::make_shared<AuditedRays>(AuditedRays{RayTracer(scene, eye), std::vector<glm::dvec3>(options.rays),
                                                          std::vector<RaySequence>(options.rays)});
    oneapi::tbb::parallel_for(std::size_t{0}, options.rays, [&](std::size_t ray) {
        rays->through[ray] = audit_point(rays->tracer, options.seed, ray);
        rays->tracer.trace(rays->through[ray], rays->sequences[ray]);
    });
    rays_ = std::move(rays);
}

std::size_t RayAudit::ray_count() const
{
    return rays_->sequences.size();
}

const RaySequence& RayAudit::sequence(std::size_t ray) const
{
    return rays_->sequences[ray];
}

const glm::dvec3& RayAudit::through(std::size_t ray) const
{
    return rays_->through[ray];
}

RayAuditResult RayAudit::check(const Order& order, std::span<const std::vector<CellId>> cycles,
                               CheckOptions options) const
{
    const Scene& scene = rays_->tracer.scene();
    const LargeArray<std::uint32_t> place = order_positions(scene, order);
    const Findings findings = oneapi::tbb::parallel_reduce(
        oneapi::tbb::blocked_range<std::size_t>(0, rays_->sequences.size(), 64), Findings{},
        [&](const auto& range, Findings part) {
            for (std::size_t ray = range.begin(); ray < range.end(); ++ray)
                look_along(rays_->sequences[ray], ray, place, part);
            return part;
        },
        [](Findings a, const Findings& b) {
            a.add(b);
            return a;
        });

    RayAuditResult result;
    result.rays = rays_->sequences.size();
    result.pairs = findings.pairs;
    result.overlapping_pairs = findings.overlapping;
    if (findings.wrong.empty())
        return result;
    const std::vector<std::uint32_t> set_of = sets_without_order(*rays_, cycles);
    struct Wrong {
        Violation violation;
        CellId back; // inner
        std::size_t ray;
    };
    std::vector<Wrong> wrong;
    const auto caller = scene.caller_cells();
    for (const auto& [pair, ray] : findings.wrong) {
        if (have_no_order(rays_->tracer, pair.first, pair.second))
            continue;
        if (set_of[pair.first] == set_of[pair.second])
            ++result.violations_in_cycles;
        else
            wrong.push_back({{caller[pair.first], caller[pair.second], {}}, pair.second, ray});
    }
    result.violations = wrong.size();
    std::sort(wrong.begin(), wrong.end(), [](const Wrong& a, const Wrong& b) {
        return std::pair(a.violation.front, a.violation.back) < std::pair(b.violation.front, b.violation.back);
    });
    wrong.resize(std::min(wrong.size(), options.max_witnesses));
    for (Wrong& w : wrong) {
        w.violation.witness = rays_->tracer.entry(rays_->through[w.ray], w.back);
        result.witnesses.push_back(w.violation);
    }
    return result;
}

} // namespace visorder
