#include "projection/optical_passes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>

namespace visorder {

namespace {

// Beyond any scalar, and no infinity: it is multiplied.
constexpr float beyond = 1e30F;

// What the polynomials of the shader are right for; see exact_pass_text.
constexpr double most_depth = 1;
// Through as many parts of that depth nothing is seen.
constexpr double most_parts = 64;

using Piece = OpticalPieces::Piece;

float extinction_at(const Piece& piece, float scalar)
{
    return piece.extinction + (scalar - piece.begin) * piece.extinction_slope;
}

// The highest within part of a piece: at one of the ends.
float most_extinction(const Piece& piece, const CellWays& ways)
{
    return std::max(extinction_at(piece, std::clamp(ways.lowest, piece.begin, piece.end)),
                    extinction_at(piece, std::clamp(ways.highest, piece.begin, piece.end)));
}

OpticalPass pass_through(const Piece& piece, float reference)
{
    const double way = static_cast<double>(reference) - static_cast<double>(piece.begin);
    const glm::dvec4 rise(piece.extinction_slope, glm::dvec3(piece.colour_slope));
    const glm::dvec4 begin(piece.extinction, glm::dvec3(piece.colour));
    return {glm::vec4(begin + way * rise), glm::vec4(rise), glm::vec4(-beyond, beyond, 0, 1)};
}

} // namespace

void find_optical_passes(const OpticalPieces& pieces, const CellWays& ways, std::vector<OpticalPass>& passes)
{
    passes.clear();
    const Piece* const first = &pieces.at(ways.lowest);
    const Piece* last = first;
    float most = most_extinction(*first, ways);
    while (last->end < ways.highest)
        most = std::max(most, most_extinction(*++last, ways));
    if (!(most > 0))
        return;
    const double depth = static_cast<double>(most) * ways.longest;
    // Written so that what is not a number is cut finely.
    const int parts = depth <= most_depth ? 1 : static_cast<int>(depth < most_parts ? std::ceil(depth) : most_parts);
    const auto count = last - first + 1;
    const bool both = count > 1 && ways.rises && ways.falls;
    const bool only_falls = ways.falls && !ways.rises;
    for (int k = 0; k < parts; ++k) {
        const int part = ways.swapped ? k : parts - 1 - k;
        for (const bool rising : {true, false}) {
            if (!both && rising == only_falls)
                continue;
            for (std::ptrdiff_t i = 0; i < count; ++i) {
                const Piece& piece = rising != ways.swapped ? last[-i] : first[i];
                if (!(most_extinction(piece, ways) > 0))
                    continue;
                OpticalPass pass = pass_through(piece, ways.reference);
                pass.window = {0, 0, parts, part};
                if (count > 1) {
                    const float low = &piece == first ? -beyond : piece.begin - ways.reference;
                    const float high = &piece == last ? beyond : piece.end - ways.reference;
                    // Too narrow for single precision; equal numbers would say all of the part.
                    if (low == high)
                        continue;
                    pass.window.x = rising ? low : high;
                    pass.window.y = rising ? high : low;
                }
                passes.push_back(pass);
            }
        }
    }
}

} // namespace visorder
