#include "projection/opengl/thick_vertex_shader.h"

#include "projection/opengl/silhouette_layout.h"

namespace visorder::detail {

namespace {

constexpr const char* text = R"(
struct Cell {
    dvec2 points[8]; // of each, where it is, and depth and scalar
    double least_width;
    uint quad, inner_behind;
#ifdef OPTICS
    vec4 optics[4];
#endif
};
layout(std430, binding = 1) readonly buffer Cells { Cell cells[]; };
uniform float lattice_steps;
uniform float half_range;
uniform double inverse_distance;

flat out vec4 shape, tents_high, tents_low, tent_offsets;
#ifdef OPTICS
flat out vec4 colour0, colour1, colour2, colour3, colour4;
#endif
#ifdef LINEAR
uniform vec3 ray_x, ray_y, ray_1; // see Screen::rays
#else
flat out vec4 rises, slopes;
#ifndef PERSPECTIVE
uniform float length_a_depth;
#endif
#endif

dvec2 at[4];     // pixels
dvec2 values[4]; // depth and scalar
double least;    // width of a face, pixels
bool quad, inner_behind;

double area(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }
dvec2 across(dvec2 e) { return dvec2(e.y, -e.x); }
dvec2 rounded(dvec2 p) { return floor(p + 0.5); }

// As fan_of has it, in lattice steps.
dvec2 corner_of_fan(dvec2 thickest, int triangle, int corner)
{
    dvec2 polygon[4];
    int count = quad ? 4 : 3;
    polygon[0] = quad ? at[0] : at[1];
    polygon[1] = at[2];
    polygon[2] = quad ? at[1] : at[3];
    polygon[3] = at[3];
    dvec2 side[4];
    double way[4];
    dvec2 moved[4];
    for (int i = 0; i < 4; ++i)
        polygon[i] *= lattice_steps;
    for (int i = 0; i < count; ++i) {
        side[i] = polygon[i + 1 == count ? 0 : i + 1] - polygon[i];
        way[i] = abs(side[i].x) + abs(side[i].y);
    }
    bool narrow = false;
    for (int i = 0; i < count; ++i) {
        int before = i == 0 ? count - 1 : i - 1;
        dvec2 off = (way[i] * side[before] - way[before] * side[i]) / abs(area(side[before], side[i]));
        // Written so that a side without length, too, makes it narrow.
        if (!(abs(off.x) < 1024.0 && abs(off.y) < 1024.0))
            narrow = true;
        moved[i] = rounded(polygon[i] + off);
    }
    if (!narrow)
        return triangle >= count || corner == 0 ? rounded(thickest * lattice_steps)
                                                : moved[(triangle + corner - 1) % count];
    // A rectangle along the longest line between two corners.
    dvec2 along = dvec2(1.0, 0.0);
    double longest = 0.0;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < i; ++k) {
            double len = length(polygon[i] - polygon[k]);
            along = len > longest ? (polygon[i] - polygon[k]) / len : along;
            longest = max(longest, len);
        }
    dvec2 low = dvec2(0.0), high = dvec2(0.0);
    for (int i = 0; i < count; ++i) {
        dvec2 p = polygon[i] - polygon[0];
        p = dvec2(dot(along, p), -dot(across(along), p));
        low = min(low, p);
        high = max(high, p);
    }
    low -= 1.0;
    high += 1.0;
    bool right = triangle == 0 ? corner > 0 : corner == 1;
    bool top = triangle == 0 ? corner == 2 : corner > 0;
    if (triangle > 1)
        right = top = false;
    return rounded(polygon[0] + along * (right ? high.x : low.x) - across(along) * (top ? high.y : low.y));
}

// Twice the area of a triangle with a narrow face at its side, if that is as wide as the least.
double widened(double area_of, dvec2 side)
{
    return max(abs(area_of), least * length(side));
}

// As split_linear has it: high slope and offset, low slope and offset.
void split(dvec2 slope, double offset, double reach, out vec3 high, out vec3 low)
{
    double terms = 2.0 * reach * max(abs(slope.x), abs(slope.y)) + abs(offset);
    int exponent;
    frexp(terms, exponent);
    double unit = ldexp(1.0lf, exponent - 23);
    dvec3 all = dvec3(slope, offset);
    dvec3 coarse = floor(all / unit + 0.5) * unit;
    high = vec3(coarse);
    low = vec3(all - coarse);
}

void main()
{
    int cell = gl_VertexID / 12;
    int triangle = gl_VertexID % 12 / 3;
    int corner = gl_VertexID % 3;
    for (int i = 0; i < 4; ++i) {
        at[i] = cells[cell].points[2 * i];
        values[i] = cells[cell].points[2 * i + 1];
    }
    least = max(cells[cell].least_width, 1e-12lf);
    quad = cells[cell].quad != 0u;
    inner_behind = cells[cell].inner_behind != 0u;

    // See Thickness.
    dvec2 b = at[1] - at[0], c = at[2] - at[0], d = at[3] - at[0];
    dvec2 thickest = at[0];
    dvec2 slope1, slope2, third = dvec2(0.0);
    double first1 = 0.0, opposite = 0.0;
    dvec2 base, rise, along1, along2;  // of depth and scalar
    int outer[3] = int[3](1, 2, 3);
    dvec3 shares = dvec3(0.0);         // of those at the inner point
    double way1 = 0.0, way2 = 0.0;     // of a quad, to where its edges cross
    if (quad) {
        dvec2 farther = d - c;
        double whole = area(b, farther);
        way1 = area(c, farther) / whole;
        way2 = area(c, b) / whole;
        thickest += way1 * b;
        slope1 = -across(farther) / area(c, farther);
        slope2 = across(b) / area(c, b);
        first1 = 1.0;
        third.x = -abs(area(c, farther)) / widened(area(c - b, farther), farther);
        opposite = -abs(area(c, b)) / widened(area(d, b), b);
        dvec2 before = values[0] + way1 * (values[1] - values[0]);
        dvec2 behind = values[2] + way2 * (values[3] - values[2]);
        base = before;
        rise = behind - before;
        along1 = values[0] - before;
        along2 = values[2] - behind;
    } else {
        double areas[4];
        areas[1] = area(c, d);
        areas[2] = area(d, b);
        areas[3] = area(b, c);
        double whole = areas[1] + areas[2] + areas[3];
        double turn = whole < 0.0 ? -1.0 : 1.0;
        int largest = 1;
        for (int i = 2; i < 4; ++i)
            if (turn * areas[i] > turn * areas[largest])
                largest = i;
        outer[0] = largest % 3 + 1;
        outer[1] = outer[0] % 3 + 1;
        outer[2] = largest;
        dvec2 side1 = at[largest] - at[outer[1]], side2 = at[outer[0]] - at[largest];
        double area1 = widened(areas[outer[0]], side1), area2 = widened(areas[outer[1]], side2);
        shares = dvec3(area1, area2, turn * areas[largest]) / abs(whole);
        slope1 = turn * across(side1) / area1;
        slope2 = turn * across(side2) / area2;
        third = dvec2(-area1, -area2) / (turn * areas[largest]);
        along1 = shares.x * (values[largest] - values[outer[0]]);
        along2 = shares.y * (values[largest] - values[outer[1]]);
        base = values[largest] - along1 - along2;
        rise = values[0] - base;
    }
    bool swapped = !quad && !inner_behind;

    gl_Position = vec4(vec2(corner_of_fan(thickest, triangle, corner)) / (lattice_steps * half_range), 0.0, 1.0);
    // See PackedPlace.
    dvec2 middle = floor(at[0]) + 0.5;
    vec2 positive = vec2(middle + centre + double(PLACE_OFFSET));
    hand_on_place(vec2(positive.x, swapped ? -positive.y : positive.y));
    shape = vec4(third, opposite, quad ? 0.0 : 1.0);
    dvec2 beside = at[0] - middle;
    double reach = 2.0;
    for (int i = 1; i < 4; ++i)
        reach = max(reach, 2.0 + max(abs(at[i].x - at[0].x), abs(at[i].y - at[0].y)));
    vec3 high1, low1, high2, low2;
    split(slope1, first1 - dot(slope1, beside), reach, high1, low1);
    split(slope2, -dot(slope2, beside), reach, high2, low2);
    tents_high = vec4(high1.xy, high2.xy);
    tents_low = vec4(low1.xy, low2.xy);
    tent_offsets = vec4(high1.z, high2.z, low1.z, low2.z);
#ifndef LINEAR
    // See SilhouetteTriangles.
    double scale = 1.0 / (1.0 - base.x * inverse_distance);
    double depth_rise = (swapped ? -rise.x : rise.x) * scale * scale;
#ifndef PERSPECTIVE
    depth_rise *= length_a_depth;
#endif
    rises = vec4(depth_rise, scale * rise.y, scale * base.y, -scale * inverse_distance * rise.x);
    slopes = vec4(scale * along1.y, scale * along2.y, -scale * inverse_distance * along1.x,
                  -scale * inverse_distance * along2.x);
#endif
#ifdef OPTICS
    vec4 o[4] = cells[cell].optics;
    vec4 thick = 0.5 * (quad ? mix(o[0], o[1], float(way1)) + mix(o[2], o[3], float(way2))
                             : o[0] + float(shares.x) * o[outer[0]] + float(shares.y) * o[outer[1]] +
                                   float(shares.z) * o[outer[2]]);
#ifdef LINEAR
    double before = quad ? base.x : values[0].x;
    double behind = before + (quad ? rise.x : -rise.x);
    double len = abs(rise.x) / ((1.0 - before * inverse_distance) * (1.0 - behind * inverse_distance)) *
                 length(float(thickest.x) * ray_x + float(thickest.y) * ray_y + ray_1);
    thick.w = 1.0 - exp(-thick.w * float(len));
#endif
    colour0 = thick;
    if (quad) {
        colour1 = (o[0] - o[1]) / float(1.0 - 1.0 / third.x);
        colour2 = (o[2] - o[3]) / float(1.0 - 1.0 / opposite);
        colour3 = o[2] - thick - colour2;
        colour4 = o[0] - thick - colour1;
    } else {
        colour1 = float(shares.x) * (o[outer[2]] - o[outer[0]]);
        colour2 = float(shares.y) * (o[outer[2]] - o[outer[1]]);
        colour3 = vec4(0.0);
        colour4 = o[outer[2]] - colour1 - colour2 - thick;
    }
#endif
}
)";

} // namespace

std::string thick_vertex_shader()
{
    return place_vertex_shader() + text;
}

} // namespace visorder::detail
