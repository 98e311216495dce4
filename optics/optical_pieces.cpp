#include "optics/optical_pieces.h"

#include <algorithm>
#include <span>

namespace visorder::detail {

namespace {

// Finite, so that a slope of zero times a distance from it is zero.
constexpr double beyond = 1e30;
constexpr std::size_t parts = 1024;

// Of equal parts of [0, 1], the piece in which each begins.
template <class Piece>
std::vector<std::int32_t> first_of_parts(std::span<const Piece> pieces)
{
    std::vector<std::int32_t> first(parts);
    std::int32_t piece = 0;
    for (std::size_t i = 0; i < parts; ++i) {
        while (static_cast<double>(i) / static_cast<double>(parts) >=
               static_cast<double>(pieces[static_cast<std::size_t>(piece)].end))
            ++piece;
        first[i] = piece;
    }
    return first;
}

} // namespace

const OpticalPieces::Piece& OpticalPieces::at(double scalar) const
{
    const double place = std::clamp(scalar, 0.0, 1.0) * static_cast<double>(first_piece.size());
    const auto part = std::min(static_cast<std::size_t>(place), first_piece.size() - 1);
    auto piece = static_cast<std::size_t>(scalar < 0 ? 0 : first_piece[part]);
    while (scalar >= pieces[piece].end)
        ++piece;
    return pieces[piece];
}

OpticalPieces optical_pieces(const TransferFunction& function, double lowest, double range)
{
    OpticalPieces result;
    const std::span<const OpticalPoint> points = function.points();
    const auto scaled = [&](double scalar) { return std::clamp((scalar - lowest) / range, -beyond, beyond); };
    const auto constant = [](const OpticalPoint& p, double begin, double end) {
        return OpticalPieces::Piece{begin, end, p.extinction, 0, glm::vec4(p.colour, 0), glm::vec4(0)};
    };
    result.pieces.push_back(constant(points.front(), -beyond, scaled(points.front().scalar)));
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const OpticalPoint& a = points[i];
        const OpticalPoint& b = points[i + 1];
        const double begin = scaled(a.scalar);
        const double end = scaled(b.scalar);
        if (begin == end)
            continue;
        const double rise = 1 / (end - begin);
        result.pieces.push_back({begin, end, a.extinction, (b.extinction - a.extinction) * rise, glm::vec4(a.colour, 0),
                                 glm::vec4((b.colour - a.colour) * rise, 0)});
    }
    result.pieces.push_back(constant(points.back(), scaled(points.back().scalar), beyond));
    result.first_piece = first_of_parts(std::span<const OpticalPieces::Piece>(result.pieces));
    return result;
}

NarrowedPieces narrowed(const OpticalPieces& pieces)
{
    NarrowedPieces result;
    for (const OpticalPieces::Piece& p : pieces.pieces) {
        const auto begin = static_cast<float>(p.begin);
        const auto end = static_cast<float>(p.end);
        if (begin == end)
            continue;
        result.pieces.push_back({begin, end, static_cast<float>(p.extinction), static_cast<float>(p.extinction_slope),
                                 p.colour, p.colour_slope});
    }
    result.first_piece = first_of_parts(std::span<const NarrowedPieces::Piece>(result.pieces));
    return result;
}

} // namespace visorder::detail
