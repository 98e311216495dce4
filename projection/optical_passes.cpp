#include "projection/optical_passes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>

namespace visorder::detail {

namespace {

// Beyond any scalar, and no infinity: it is multiplied.
constexpr float beyond = 1e30F;

using Piece = OpticalPieces::Piece;

double extinction_at(const Piece& piece, double scalar)
{
    return piece.extinction + (scalar - piece.begin) * piece.extinction_slope;
}

// The highest within part of a piece: at one of the ends.
double most_extinction(const Piece& piece, double lowest, double highest)
{
    return std::max(extinction_at(piece, std::clamp(lowest, piece.begin, piece.end)),
                    extinction_at(piece, std::clamp(highest, piece.begin, piece.end)));
}

OpticalPass pass_through(const Piece& piece, double reference)
{
    const double way = reference - piece.begin;
    const glm::dvec4 rise(piece.extinction_slope, glm::dvec3(piece.colour_slope));
    const glm::dvec4 begin(piece.extinction, glm::dvec3(piece.colour));
    return {glm::vec4(begin + way * rise), glm::vec4(rise), glm::vec4(-beyond, beyond, 0, 1)};
}

// Of an optical depth, by bounds that are ten times what comes of it.
constexpr double most_error = 5e-7;

// Few rays lie in what takes a smaller part of a cell's scalars: it is as good as a jump.
constexpr double narrow = 0x1p-10;

// Nearly all rays through a cell meet more than this part of its scalars, which says how well they tell where a jump
// is.
constexpr double least_part_met = 0x1p-4;

// What is most within the ways through a cell. `error`: of a scalar.
struct Density {
    const Piece* first;
    const Piece* last;
    double extinction;
    double change; // of the extinction at some place, where the scalar is off

    bool single_precision_is_enough(double longest) const
    {
        // Written so that what is not a number is too much.
        return extinction * longest <= most_depth_in_single_precision && change * longest <= most_error;
    }
};

Density density_of(const OpticalPieces& pieces, double lowest, double highest, double error)
{
    const Piece* const first = &pieces.at(lowest);
    Density density{first, first, 0, 0};
    const double run = highest - lowest;
    // A jump is off its place by a part of the ray segment.
    const double part = least_part_met * run > error ? error / (least_part_met * run) : 1;
    for (const Piece* piece = first;; ++piece) {
        const double most = most_extinction(*piece, lowest, highest);
        density.last = piece;
        density.extinction = std::max(density.extinction, most);
        const double off =
            piece->end - piece->begin < narrow * run ? most * part : std::abs(piece->extinction_slope) * error;
        density.change = std::max(density.change, std::min(off, most));
        if (piece != first) {
            const double jump = std::abs(extinction_at(piece[-1], piece[-1].end) - piece->extinction);
            density.change = std::max(density.change, jump * part);
        }
        if (!(piece->end < highest))
            return density;
    }
}

} // namespace

bool find_optical_passes(const OpticalPieces& pieces, const CellWays& ways, std::vector<OpticalPass>& passes)
{
    passes.clear();
    // Scalars are relative to one of the cell's.
    const double error = 0x1p-23 * (ways.highest - ways.lowest);
    const Density density = density_of(pieces, ways.lowest, ways.highest, error);
    if (!(density.extinction > 0))
        return true;
    if (!density.single_precision_is_enough(ways.longest))
        return false;
    const Piece* const first = density.first;
    const Piece* const last = density.last;
    // What the polynomials of the shader are right for; see stretch_text.
    const int parts = std::max(1, static_cast<int>(std::ceil(density.extinction * ways.longest)));
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
                if (!(most_extinction(piece, ways.lowest, ways.highest) > 0))
                    continue;
                OpticalPass pass = pass_through(piece, ways.reference);
                pass.window = {0, 0, parts, part};
                if (count > 1) {
                    const float low = &piece == first ? -beyond : static_cast<float>(piece.begin - ways.reference);
                    const float high = &piece == last ? beyond : static_cast<float>(piece.end - ways.reference);
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
    return true;
}

bool looked_up_in_single_precision(const OpticalPieces& pieces, double lowest, double highest, double longest)
{
    constexpr double error = 0x1p-23;
    return density_of(pieces, lowest, highest, error).single_precision_is_enough(longest);
}

} // namespace visorder::detail
