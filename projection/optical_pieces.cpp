#include "projection/optical_pieces.h"

#include <algorithm>
#include <span>

namespace visorder {

namespace {

// Finite, so that a slope of zero times a distance from it is zero.
constexpr float beyond = 1e30F;
constexpr std::size_t parts = 1024;

} // namespace

const OpticalPieces::Piece& OpticalPieces::at(float scalar) const
{
    const float place = std::clamp(scalar, 0.0F, 1.0F) * static_cast<float>(first_piece.size());
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
    const auto scaled = [&](double scalar) {
        return std::clamp(static_cast<float>((scalar - lowest) / range), -beyond, beyond);
    };
    const auto constant = [](const OpticalPoint& p, float begin, float end) {
        return OpticalPieces::Piece{begin,       end, static_cast<float>(p.extinction), 0, glm::vec4(p.colour, 0),
                                    glm::vec4(0)};
    };
    result.pieces.push_back(constant(points.front(), -beyond, scaled(points.front().scalar)));
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const OpticalPoint& a = points[i];
        const OpticalPoint& b = points[i + 1];
        const float begin = scaled(a.scalar);
        const float end = scaled(b.scalar);
        // What is too narrow for single precision is a jump.
        if (begin == end)
            continue;
        const double rise = 1 / (static_cast<double>(end) - begin);
        result.pieces.push_back({begin, end, static_cast<float>(a.extinction),
                                 static_cast<float>((b.extinction - a.extinction) * rise), glm::vec4(a.colour, 0),
                                 glm::vec4((b.colour - a.colour) * rise, 0)});
    }
    result.pieces.push_back(constant(points.back(), scaled(points.back().scalar), beyond));

    result.first_piece.resize(parts);
    std::int32_t piece = 0;
    for (std::size_t i = 0; i < parts; ++i) {
        while (static_cast<float>(i) / static_cast<float>(parts) >= result.pieces[static_cast<std::size_t>(piece)].end)
            ++piece;
        result.first_piece[i] = piece;
    }
    return result;
}

} // namespace visorder
