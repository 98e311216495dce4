#include "projection/silhouette.h"

namespace visorder {

namespace {

double doubled_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// By which points have a positive and which a negative share in the affine dependency (bit i: point i).
Silhouette by_signs(unsigned positive, unsigned negative)
{
    Silhouette result;
    constexpr unsigned everything = 15;
    const auto count = [](unsigned bits) { return (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1) + (bits >> 3 & 1); };
    std::size_t next = 0;
    const auto put = [&](unsigned bits) {
        for (std::uint8_t i = 0; i < 4; ++i)
            if ((bits >> i & 1) != 0)
                result.points[next++] = i;
    };
    if (count(positive) == 2 && count(negative) == 2) {
        result.kind = SilhouetteClass::quad;
        put(positive);
        put(negative);
        result.first_behind = true;
    } else if (count(positive) == 1 || count(negative) == 1) {
        const unsigned inner = count(positive) == 1 ? positive : negative;
        result.kind = SilhouetteClass::triangle;
        put(inner);
        put(everything & ~inner);
        result.first_behind = inner == positive;
    }
    return result;
}

constexpr std::size_t sign_patterns = 256;

std::array<Silhouette, sign_patterns> all_patterns()
{
    std::array<Silhouette, sign_patterns> table;
    for (unsigned positive = 0; positive < 16; ++positive)
        for (unsigned negative = 0; negative < 16; ++negative)
            if ((positive & negative) == 0)
                table[positive << 4 | negative] = by_signs(positive, negative);
    return table;
}

} // namespace

Silhouette silhouette_of(const std::array<glm::dvec2, 4>& points)
{
    static const std::array<Silhouette, sign_patterns> table = all_patterns();
    const std::array<double, 4> share{
        doubled_area(points[1], points[2], points[3]), -doubled_area(points[0], points[2], points[3]),
        doubled_area(points[0], points[1], points[3]), -doubled_area(points[0], points[1], points[2])};
    unsigned positive = 0;
    unsigned negative = 0;
    for (unsigned i = 0; i < 4; ++i) {
        positive |= static_cast<unsigned>(share[i] > 0) << i;
        negative |= static_cast<unsigned>(share[i] < 0) << i;
    }
    return table[positive << 4 | negative];
}

} // namespace visorder
