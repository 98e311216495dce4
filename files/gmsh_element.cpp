// Types and their nodes as Gmsh's manual has them, section "MSH file format", and for higher orders its GmshDefines.h.

#include "files/gmsh_element.h"

#include <algorithm>
#include <array>

namespace visorder::detail {

namespace {

struct Entry {
    int type;
    ListedShape shape;
    std::size_t nodes;
};

constexpr auto lower = ListedShape::lower;
constexpr auto polygon = ListedShape::polygon;
constexpr auto tetrahedron = ListedShape::tetrahedron;
constexpr auto hexahedron = ListedShape::hexahedron;
constexpr auto wedge = ListedShape::wedge;
constexpr auto pyramid = ListedShape::pyramid;

constexpr std::array quadrilaterals{3, 10, 16, 36, 37, 38, 47, 48, 49, 50, 51};
constexpr std::array entries{
    Entry{1, lower, 2},          Entry{2, polygon, 3},        Entry{3, polygon, 4},        Entry{4, tetrahedron, 4},
    Entry{5, hexahedron, 8},     Entry{6, wedge, 6},          Entry{7, pyramid, 5},        Entry{8, lower, 3},
    Entry{9, polygon, 6},        Entry{10, polygon, 9},       Entry{11, tetrahedron, 10},  Entry{12, hexahedron, 27},
    Entry{13, wedge, 18},        Entry{14, pyramid, 14},      Entry{15, lower, 1},         Entry{16, polygon, 8},
    Entry{17, hexahedron, 20},   Entry{18, wedge, 15},        Entry{19, pyramid, 13},      Entry{20, polygon, 9},
    Entry{21, polygon, 10},      Entry{22, polygon, 12},      Entry{23, polygon, 15},      Entry{24, polygon, 15},
    Entry{25, polygon, 21},      Entry{26, lower, 4},         Entry{27, lower, 5},         Entry{28, lower, 6},
    Entry{29, tetrahedron, 20},  Entry{30, tetrahedron, 35},  Entry{31, tetrahedron, 56},  Entry{36, polygon, 16},
    Entry{37, polygon, 25},      Entry{38, polygon, 36},      Entry{42, polygon, 28},      Entry{43, polygon, 36},
    Entry{44, polygon, 45},      Entry{45, polygon, 55},      Entry{46, polygon, 66},      Entry{47, polygon, 49},
    Entry{48, polygon, 64},      Entry{49, polygon, 81},      Entry{50, polygon, 100},     Entry{51, polygon, 121},
    Entry{62, lower, 7},         Entry{63, lower, 8},         Entry{64, lower, 9},         Entry{65, lower, 10},
    Entry{66, lower, 11},        Entry{71, tetrahedron, 84},  Entry{72, tetrahedron, 120}, Entry{73, tetrahedron, 165},
    Entry{74, tetrahedron, 220}, Entry{75, tetrahedron, 286}, Entry{90, wedge, 40},        Entry{91, wedge, 75},
    Entry{92, hexahedron, 64},   Entry{93, hexahedron, 125},  Entry{94, hexahedron, 216},  Entry{95, hexahedron, 343},
    Entry{96, hexahedron, 512},  Entry{97, hexahedron, 729},  Entry{98, hexahedron, 1000}, Entry{106, wedge, 126},
    Entry{107, wedge, 196},      Entry{108, wedge, 288},      Entry{109, wedge, 405},      Entry{110, wedge, 550},
};

std::size_t corner_count(const Entry& entry)
{
    switch (entry.shape) {
    case polygon:
        return std::find(quadrilaterals.begin(), quadrilaterals.end(), entry.type) == quadrilaterals.end() ? 3 : 4;
    case tetrahedron:
        return 4;
    case pyramid:
        return 5;
    case wedge:
        return 6;
    case hexahedron:
        return 8;
    default:
        return 0;
    }
}

} // namespace

std::optional<GmshElement> gmsh_element(std::int64_t type)
{
    const auto* found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.type == type; });
    if (found == entries.end())
        return {};
    return GmshElement{found->shape, found->nodes, corner_count(*found)};
}

void reorder_gmsh_corners(ListedShape shape, std::span<std::int64_t> corners)
{
    // Seen from outside, VTK's wedge begins with a triangle that runs the other way round.
    if (shape == ListedShape::wedge) {
        std::swap(corners[1], corners[2]);
        std::swap(corners[4], corners[5]);
    }
}

} // namespace visorder::detail
