#include "projection/thick_vertex_shader.h"

namespace visorder {

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
uniform vec2 centre;
uniform double inverse_distance;

flat out vec4 place, tents;
flat out vec2 beside;
#ifdef OPTICS
flat out vec4 colour0, colour1, colour2, colour3, colour4;
#endif
#ifdef LINEAR
uniform vec3 ray_x, ray_y, ray_1; // see Screen::rays
#else
flat out vec4 rises, slopes;
#ifdef PERSPECTIVE
uniform vec3 ray_constant, ray_quadratic; // of the length of rays, squared, over gl_FragCoord
flat out vec3 ray0, ray2;
#else
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
    dvec2 outwards[4];
    dvec2 moved[4];
    double whole = 0.0;
    for (int i = 0; i < 4; ++i)
        polygon[i] *= lattice_steps;
    for (int i = 1; i + 1 < count; ++i)
        whole += area(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    for (int i = 0; i < count; ++i) {
        dvec2 side = polygon[i + 1 == count ? 0 : i + 1] - polygon[i];
        outwards[i] = across(side) * ((whole < 0.0 ? -1.0 : 1.0) / length(side));
    }
    bool narrow = false;
    for (int i = 0; i < count; ++i) {
        dvec2 before = outwards[i == 0 ? count - 1 : i - 1];
        double both = 1.0 + dot(before, outwards[i]);
        // Written so that a side without length, too, makes it narrow.
        if (!(both > 2.0 / (1024.0 * 1024.0)))
            narrow = true;
        moved[i] = rounded(polygon[i] + (before + outwards[i]) / both);
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

// One at the far edge of a triangle beside the inner point, as thickness_of has it.
dvec2 tent(dvec2 a, dvec2 b, double whole)
{
    dvec2 edge = b - a;
    double wide = max(whole > 0.0 ? area(a, b) : -area(a, b), least * length(edge));
    return wide == 0.0 ? dvec2(0.0) : across(edge) / (whole > 0.0 ? wide : -wide);
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
    dvec2 k1, k2, k3;
    dvec2 base, rise, slope_x, slope_y; // of depth and scalar
    dvec3 shares = dvec3(0.0);          // of the outer points at the inner one
    dvec2 share_b = dvec2(0.0), share_c = dvec2(0.0), share_d = dvec2(0.0);
    double along1 = 0.0, along2 = 0.0, opposite1 = 0.0, opposite2 = 0.0;
    if (quad) {
        dvec2 farther = d - c;
        double whole = area(b, farther);
        along1 = area(c, farther) / whole;
        along2 = area(c, b) / whole;
        thickest += along1 * b;
        k1 = -across(farther) / area(c, farther);
        k2 = across(b) / area(c, b);
        opposite1 = -max((1.0 - along1) / along1, least * length(k1));
        opposite2 = -max((1.0 - along2) / along2, least * length(k2));
        k3 = dvec2(1.0 / opposite1, 1.0 / opposite2);
        dvec2 before = values[0] + along1 * (values[1] - values[0]);
        dvec2 behind = values[2] + along2 * (values[3] - values[2]);
        base = values[0];
        rise = behind - before;
        slope_x = (values[0] - before) * k1.x + (values[2] - behind) * k2.x;
        slope_y = (values[0] - before) * k1.y + (values[2] - behind) * k2.y;
    } else {
        shares = dvec3(area(c, d), area(d, b), area(b, c));
        double whole = shares.x + shares.y + shares.z;
        shares /= whole;
        share_b = across(c - d) / whole;
        share_c = across(d - b) / whole;
        share_d = across(b - c) / whole;
        k1 = tent(b, c, whole);
        k2 = tent(c, d, whole);
        k3 = tent(d, b, whole);
        base = shares.x * values[1] + shares.y * values[2] + shares.z * values[3];
        rise = values[0] - base;
        slope_x = share_b.x * values[1] + share_c.x * values[2] + share_d.x * values[3];
        slope_y = share_b.y * values[1] + share_c.y * values[2] + share_d.y * values[3];
    }
    bool swapped = !quad && !inner_behind;

    gl_Position = vec4(vec2(corner_of_fan(thickest, triangle, corner)) / (lattice_steps * half_range), 0.0, 1.0);
    // See PackedPlace.
    dvec2 on_lattice = rounded(at[0] * lattice_steps) / double(lattice_steps);
    vec2 positive = vec2(on_lattice + centre) + PLACE_OFFSET;
    place = vec4(quad ? -positive.x : positive.x, swapped ? -positive.y : positive.y, k3);
    beside = vec2(at[0] - on_lattice);
    tents = vec4(k1, k2);
#ifndef LINEAR
    // All relative to what 1 - depth / D is at the first point; see SilhouetteTriangles.
    double scale = 1.0 / (1.0 - base.x * inverse_distance);
    double depth_rise = (swapped ? -rise.x : rise.x) * scale * scale;
#ifdef PERSPECTIVE
    ray0 = ray_constant;
    ray2 = ray_quadratic;
#else
    depth_rise *= length_a_depth;
#endif
    rises = vec4(depth_rise, scale * rise.y, scale * base.y, -scale * inverse_distance * rise.x);
    slopes = vec4(scale * slope_x.y, scale * slope_y.y, -scale * inverse_distance * slope_x.x,
                  -scale * inverse_distance * slope_y.x);
#endif
#ifdef OPTICS
    vec4 o0 = cells[cell].optics[0], o1 = cells[cell].optics[1];
    vec4 o2 = cells[cell].optics[2], o3 = cells[cell].optics[3];
    vec4 thick = 0.5 * (quad ? mix(o0, o1, float(along1)) + mix(o2, o3, float(along2))
                             : o0 + float(shares.x) * o1 + float(shares.y) * o2 + float(shares.z) * o3);
#ifdef LINEAR
    double before = quad ? values[0].x + along1 * (values[1].x - values[0].x) : values[0].x;
    double behind = before + (quad ? rise.x : -rise.x);
    double len = abs(rise.x) / ((1.0 - before * inverse_distance) * (1.0 - behind * inverse_distance)) *
                 length(float(thickest.x) * ray_x + float(thickest.y) * ray_y + ray_1);
    thick.w = 1.0 - exp(-thick.w * float(len));
    o0.w = o1.w = o2.w = o3.w = 0.0;
#endif
    if (quad) {
        vec4 slope1 = (o0 - o1) / float(1.0 - opposite1);
        vec4 slope2 = (o2 - o3) / float(1.0 - opposite2);
        colour0 = thick + slope1;
        colour1 = float(k1.x) * slope1 + float(k2.x) * slope2;
        colour2 = float(k1.y) * slope1 + float(k2.y) * slope2;
        colour3 = o2 - thick - slope2;
        colour4 = o0 - thick - slope1;
    } else {
        vec4 face = float(shares.x) * o1 + float(shares.y) * o2 + float(shares.z) * o3;
        colour0 = thick;
        colour1 = float(share_b.x) * o1 + float(share_c.x) * o2 + float(share_d.x) * o3;
        colour2 = float(share_b.y) * o1 + float(share_c.y) * o2 + float(share_d.y) * o3;
        colour3 = vec4(0.0);
        colour4 = face - thick;
    }
#endif
}
)";

} // namespace

const char* thick_vertex_shader()
{
    return text;
}

} // namespace visorder
