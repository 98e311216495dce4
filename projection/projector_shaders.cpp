#include "projection/projector_shaders.h"

#include "projection/integrator_shaders.h"
#include "projection/silhouette_layout.h"

namespace visorder {

namespace {

std::string header(Integrator integrator)
{
    std::string text = "#version 450 core\n";
    if (needs_optics(integrator))
        text += "#define OPTICS\n";
    if (integrator == Integrator::linear)
        text += "#define LINEAR\n";
    return text;
}

constexpr const char* planes_vertex_text = R"(
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) readonly buffer Records { uvec4 records[]; };
uniform float lattice_steps;
uniform float half_range;

flat out vec4 point0, point1, point2, point3;
flat out uint kind;
flat out float steps;
#ifdef OPTICS
flat out vec4 optics0, optics1, optics2, optics3;
#endif

void main()
{
    uvec4 record = records[gl_VertexID / 3];
    int corner = gl_VertexID % 3;
    kind = record.x >> 30;
    steps = lattice_steps;
    point0 = points[record.x & 0x3fffffffu];
    point1 = points[record.y];
    point2 = points[record.z];
    point3 = points[record.w];
    vec2 first = kind < 2u ? point3.xy : point0.xy;
    vec2 third = kind == 3u ? point3.xy : point2.xy;
    vec2 place = corner == 0 ? first : corner == 1 ? point1.xy : third;
    // Dividing by powers of two is exact, and the viewport multiplies again.
    gl_Position = vec4(roundEven(place * lattice_steps) / (lattice_steps * half_range), 0.0, 1.0);
#ifdef OPTICS
    optics0 = optics_at(point0.w);
    optics1 = optics_at(point1.w);
    optics2 = optics_at(point2.w);
    optics3 = optics_at(point3.w);
#endif
    hand_on_view();
}
)";

constexpr const char* result_text = R"(
layout(location = 0) out vec4 result;
)";

constexpr const char* near_ray_text = R"(
uniform vec2 centre;                 // of the image, pixels
uniform vec3 ray_x, ray_y, ray_1;    // see Screen::rays

float length_per_depth(vec2 pixel)
{
    return length(pixel.x * ray_x + pixel.y * ray_y + ray_1);
}
)";

// Of the view, what is the same for all fragments. Vertex shaders hand it on: software renderers gather a uniform for
// each fragment, but read an interpolated value once.
constexpr const char* view_vertex_text = R"(
uniform vec2 centre;                 // of the image, pixels
uniform vec3 ray_x, ray_y, ray_1;    // see Screen::rays
uniform float inverse_distance;

flat out vec4 middle_and_inverse; // centre, inverse distance
flat out vec3 ray_squares, ray_products;

void hand_on_view()
{
    middle_and_inverse = vec4(centre, inverse_distance, 0.0);
    ray_squares = vec3(dot(ray_x, ray_x), dot(ray_y, ray_y), dot(ray_1, ray_1));
    ray_products = 2.0 * vec3(dot(ray_x, ray_y), dot(ray_x, ray_1), dot(ray_y, ray_1));
}
)";

constexpr const char* view_text = R"(
flat in vec4 middle_and_inverse;
flat in vec3 ray_squares, ray_products;

#define centre middle_and_inverse.xy
#define inverse_distance middle_and_inverse.z

float length_per_depth(vec2 pixel)
{
    return sqrt((ray_squares.x * pixel.x + ray_products.x * pixel.y + ray_products.y) * pixel.x +
                (ray_squares.y * pixel.y + ray_products.z) * pixel.y + ray_squares.z);
}
)";

// A face's depth and scalar at a pixel depend on its three points alone, so that the two cells at a face agree about
// them. Which faces a ray passes through is found out for the points where the rasteriser has them, so that the cells
// that cover a pixel make a chain from face to face; and then the faces are taken where they are. What rounding to
// the lattice has moved across a pixel's centre keeps within the face.
constexpr const char* planes_text = R"(
flat in vec4 point0, point1, point2, point3;
flat in uint kind;
#ifdef OPTICS
flat in vec4 optics0, optics1, optics2, optics3;
#endif
flat in float steps;

float area(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

vec2 snapped(vec4 point) { return roundEven(point.xy * steps) / steps; }

vec3 within(vec2 a, vec2 b, vec2 c, vec2 pixel)
{
    vec2 ab = b - a, ac = c - a, ap = pixel - a;
    float whole = area(ab, ac);
    // Without area on the screen, the nearest edge decides.
    whole = whole == 0.0 ? 1e-30 : whole;
    float second = area(ap, ac) / whole;
    float third = area(ab, ap) / whole;
    vec3 shares = max(vec3(1.0 - second - third, second, third), 0.0);
    return shares / (shares.x + shares.y + shares.z);
}

void main()
{
    vec2 pixel = gl_FragCoord.xy - centre;
    bool quad = kind >= 2u;
    vec2 s0 = snapped(point0), s1 = snapped(point1), s2 = snapped(point2), s3 = snapped(point3);

    // Of a triangle: which of the three faces around the inner point. Never one without area.
    vec2 from0 = pixel - s0;
    float turn = sign(area(s2 - s1, s3 - s1));
    float by1 = turn * area(s1 - s0, from0);
    float by2 = turn * area(s2 - s0, from0);
    float by3 = turn * area(s3 - s0, from0);
    bool in23 = by2 >= 0.0 && by3 <= 0.0 && turn * area(s2 - s0, s3 - s0) > 0.0;
    bool in31 = !in23 && by3 >= 0.0 && by1 <= 0.0 && turn * area(s3 - s0, s1 - s0) > 0.0;
    // Of a quad: the face before is that of the nearer edge and the third point drawn, the face behind that of the
    // farther edge and an end of the nearer.
    bool third = kind == 2u;
    bool at0 = area(s3 - s2, pixel - s2) * area(s3 - s2, s0 - s2) >= 0.0;

    vec4 a0 = quad ? point0 : point1;
    vec4 a1 = quad ? point1 : point2;
    vec4 a2 = quad && third ? point2 : point3;
    vec4 b0 = quad ? point2 : point0;
    vec4 b1 = quad ? point3 : in23 ? point2 : in31 ? point3 : point1;
    vec4 b2 = quad ? (at0 ? point0 : point1) : in23 ? point3 : in31 ? point1 : point2;
    vec3 a = within(a0.xy, a1.xy, a2.xy, pixel);
    vec3 b = within(b0.xy, b1.xy, b2.xy, pixel);

    // Scalars are linear in space: on the screen, they are when multiplied by 1 - depth * inverse_distance.
    vec3 a_depths = vec3(a0.z, a1.z, a2.z);
    vec3 b_depths = vec3(b0.z, b1.z, b2.z);
    float a_depth = dot(a, a_depths);
    float b_depth = dot(b, b_depths);
    float a_scale = 1.0 / (1.0 - a_depth * inverse_distance);
    float b_scale = 1.0 / (1.0 - b_depth * inverse_distance);
    a *= (1.0 - a_depths * inverse_distance) * a_scale;
    b *= (1.0 - b_depths * inverse_distance) * b_scale;
    float a_scalar = dot(a, vec3(a0.w, a1.w, a2.w));
    float b_scalar = dot(b, vec3(b0.w, b1.w, b2.w));
    float len = (b_depth - a_depth) * a_scale * b_scale * length_per_depth(pixel);

    bool swapped = kind == 1u;
    len = swapped ? -len : len;
    float front = swapped ? b_scalar : a_scalar;
    float back = swapped ? a_scalar : b_scalar;
#ifdef OPTICS
    vec4 ao0 = quad ? optics0 : optics1;
    vec4 ao1 = quad ? optics1 : optics2;
    vec4 ao2 = quad && third ? optics2 : optics3;
    vec4 bo0 = quad ? optics2 : optics0;
    vec4 bo1 = quad ? optics3 : in23 ? optics2 : in31 ? optics3 : optics1;
    vec4 bo2 = quad ? (at0 ? optics0 : optics1) : in23 ? optics3 : in31 ? optics1 : optics2;
#endif
#ifdef OPTICS
    vec4 a_optics = a.x * ao0 + a.y * ao1 + a.z * ao2;
    vec4 b_optics = b.x * bo0 + b.y * bo1 + b.z * bo2;
    result = light_of(front, back, len, swapped ? b_optics : a_optics, swapped ? a_optics : b_optics);
#else
    result = light_of(front, back, len, vec4(0.0), vec4(0.0));
#endif
}
)";

// See Thickness and SilhouetteLayout. Along the ray the scalar runs from `one` to `one + run`.
constexpr const char* silhouette_text = R"(
#ifdef PERSPECTIVE
flat in vec3 ray0, ray2; // of the length of rays, squared: constant and linear, quadratic
#endif

void main()
{
    vec2 r = gl_FragCoord.xy + 16384.0 - abs(place.xy);
    bool quad = place.x < 0.0;
    bool swapped = place.y < 0.0;
    float t1 = dot(tents.xy, r) + (quad ? 1.0 : 0.0);
    float t2 = dot(tents.zw, r);
    float t3 = quad ? t1 * place.z : dot(place.zw, r);
    float g = quad ? max(t2, t2 * place.w) : 0.0;
    float m = quad ? max(t1, t3) : max(max(t1, t2), t3);
    float thickness = 1.0 - g - m;
    // The triangle drawn may reach beyond a quad.
    thickness = quad ? max(thickness, 0.0) : thickness;
#ifdef OPTICS
    vec4 optics = colour0 + colour1 * r.x + colour2 * r.y + colour3 * g + colour4 * m;
#endif
#ifdef LINEAR
    // Below zero beyond a quad.
    optics.w = max(optics.w, 0.0);
    result = vec4(optics.rgb * optics.w, optics.w);
#else
    float one = rises.z + dot(slopes.xy, r);
    float run = rises.y * thickness;
    float len = rises.x * thickness;
#ifdef PERSPECTIVE
    // Back from what is linear on the screen.
    float one_scale = 1.0 + dot(slopes.zw, r);
    float rise = rises.y * one_scale - rises.w * one;
    one_scale += rises.w * g;
    float other_scale = one_scale + rises.w * thickness;
    float scale = 1.0 / (one_scale * other_scale);
    one = (one + rises.y * g) * other_scale * scale;
    run = rise * thickness * scale;
    vec2 p = gl_FragCoord.xy;
    len *= scale * sqrt(ray0.x + (ray0.y + ray2.x * p.x + ray2.y * p.y) * p.x + (ray0.z + ray2.z * p.y) * p.y);
#else
    one += rises.y * g;
#endif
#ifdef PASSES
    result = light_of_pass(one, run, len, swapped);
#else
#ifndef OPTICS
    vec4 optics = vec4(0.0);
#endif
    result = light_of(swapped ? one + run : one, swapped ? one : one + run, len, optics, optics);
#endif
#endif
}
)";

constexpr const char* thick_vertex_text = R"(
layout(location = 0) in vec4 place_and_front;
layout(location = 1) in vec4 back_given;
#ifdef OPTICS
layout(location = 2) in vec4 optics_given;
#endif
uniform float half_range;

noperspective out vec2 front, back; // depth, and scalar times 1 - depth / D
#ifdef OPTICS
noperspective out vec4 optics;
#endif

void main()
{
    front = place_and_front.zw;
    back = back_given.xy;
#ifdef OPTICS
    optics = optics_given;
#endif
    gl_Position = vec4(place_and_front.xy / half_range, 0.0, 1.0);
    hand_on_view();
}
)";

// As silhouette_of, thick_point and BoundarySlab have it, in doubles: products of lattice coordinates are exact in
// them. A triangle that a cell does not have is a point.
constexpr const char* thick_gpu_vertex_text = R"(
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) readonly buffer Records { uvec4 records[]; };
uniform float lattice_steps;
uniform float half_range;

noperspective out vec2 front, back; // depth, and scalar times 1 - depth / D
#ifdef OPTICS
noperspective out vec4 optics;
#endif

dvec2 at[4];
dvec2 values[4]; // depth, and scalar times 1 - depth / D

double area(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }

void put(dvec2 place, dvec2 before, dvec2 behind)
{
    gl_Position = vec4(vec2(place) / (lattice_steps * half_range), 0.0, 1.0);
    front = vec2(before);
    back = vec2(behind);
}

void put_slab(uvec4 record, int corner, bool entry)
{
    dvec2 exact[3];
    for (int i = 0; i < 3; ++i)
        exact[i] = dvec2(points[record[i]].xy);
    dvec2 b = exact[1] - exact[0], c = exact[2] - exact[0];
    double b_rise = values[1].x - values[0].x, c_rise = values[2].x - values[0].x;
    dvec2 slope = (b_rise * dvec2(c.y, -c.x) - c_rise * dvec2(b.y, -b.x)) / area(b, c);
    corner = min(corner, 2);
    double depth = values[corner].x + dot(slope, at[corner] / double(lattice_steps) - exact[corner]);
    dvec2 moved = dvec2(depth, values[corner].y * (1.0 - depth * inverse_distance) /
                                   (1.0 - values[corner].x * inverse_distance));
    put(at[corner], entry ? moved : values[corner], entry ? values[corner] : moved);
}

void main()
{
    uvec4 record = records[gl_VertexID / 12];
    int corner = gl_VertexID % 12;
    uint kind = record.x >> 30;
    record.x &= 0x3fffffffu;
    vec4 optics_of[4];
    for (int i = 0; i < 4; ++i) {
        vec4 point = points[record[i]];
        at[i] = dvec2(roundEven(point.xy * lattice_steps));
        values[i] = dvec2(point.z, point.w * (1.0 - double(point.z) * inverse_distance));
#ifdef OPTICS
        optics_of[i] = optics_at(point.w);
#endif
    }
    // The first is where the thickest point may be, or one of the nearer edge; then see VisibleCell.
    ivec4 order = ivec4(0);
    bool quad = false, behind = false, none = false;
    {
        double share[4] = {area(at[2] - at[1], at[3] - at[1]), -area(at[2] - at[0], at[3] - at[0]),
                           area(at[1] - at[0], at[3] - at[0]), -area(at[1] - at[0], at[2] - at[0])};
        int positive = 0, negative = 0;
        for (int i = 0; i < 4; ++i) {
            positive |= share[i] > 0.0 ? 1 << i : 0;
            negative |= share[i] < 0.0 ? 1 << i : 0;
        }
        int positives = bitCount(positive), negatives = bitCount(negative);
        quad = positives == 2 && negatives == 2;
        none = !quad && positives != 1 && negatives != 1;
        int first = quad || positives == 1 ? positive : negative;
        behind = (first == positive) != (kind == 1u);
        // The nearer edge of a quad comes first.
        first = quad && behind ? negative : first;
        int next = 0;
        for (int i = 0; i < 4; ++i)
            if ((first >> i & 1) != 0)
                order[next++] = i;
        for (int i = 0; i < 4; ++i)
            if ((first >> i & 1) == 0 && next < 4)
                order[next++] = i;
    }
    int triangle = corner / 3;
    int k = corner % 3;
    if (kind >= 2u) {
        put_slab(record, corner, kind == 2u);
#ifdef OPTICS
        optics = optics_of[min(corner, 2)];
#endif
    } else if (none || (!quad && triangle == 3)) {
        put(at[0], values[0], values[0]);
#ifdef OPTICS
        optics = vec4(0.0);
#endif
    } else if (k > 0) {
        int i = quad ? (k == 1 ? order[triangle >> 1] : order[2 + (triangle & 1)])
                     : order[1 + (triangle + k - 1) % 3];
        put(at[i], values[i], values[i]);
#ifdef OPTICS
        optics = optics_of[i];
#endif
    } else {
        int a = order[0], b = order[1], c = order[2], d = order[3];
        dvec2 second = at[b] - at[a], third = at[c] - at[a], fourth = at[d] - at[a];
        dvec2 place = at[a];
        dvec2 before, after;
        double by_b, by_c, by_d;
        if (quad) {
            dvec2 farther = fourth - third;
            double whole = area(second, farther);
            by_b = area(third, farther) / whole;
            by_d = area(third, second) / whole;
            by_c = 1.0 - by_d;
            place += by_b * second;
            before = mix(values[a], values[b], by_b);
            after = mix(values[c], values[d], by_d);
        } else {
            by_b = area(third, fourth);
            by_c = area(fourth, second);
            by_d = area(second, third);
            double whole = by_b + by_c + by_d;
            by_b /= whole;
            by_c /= whole;
            by_d /= whole;
            dvec2 face = by_b * values[b] + by_c * values[c] + by_d * values[d];
            before = behind ? face : values[a];
            after = behind ? values[a] : face;
        }
        put(place, before, after);
#ifdef OPTICS
        vec4 far = float(by_c) * optics_of[c] + float(by_d) * optics_of[d];
        optics = 0.5 * (quad ? mix(optics_of[a], optics_of[b], float(by_b)) + far
                             : optics_of[a] + float(by_b) * optics_of[b] + far);
#ifdef LINEAR
        vec2 pixel = vec2(place) / lattice_steps;
        double len = (after.x - before.x) /
                     ((1.0 - before.x * inverse_distance) * (1.0 - after.x * inverse_distance)) *
                     length(pixel.x * ray_x + pixel.y * ray_y + ray_1);
        optics.w = 1.0 - exp(-optics.w * float(len));
#endif
#endif
    }
#ifdef LINEAR
    optics.w = k > 0 ? 0.0 : optics.w;
#endif
    hand_on_view();
}
)";

constexpr const char* thick_text = R"(
noperspective in vec2 front, back;
#ifdef OPTICS
noperspective in vec4 optics;
#else
const vec4 optics = vec4(0.0);
#endif

void main()
{
#ifdef LINEAR
    result = vec4(optics.rgb * optics.w, optics.w);
#else
    float front_scale = 1.0 - front.x * inverse_distance;
    float back_scale = 1.0 - back.x * inverse_distance;
    float len = (back.x - front.x) / (front_scale * back_scale) * length_per_depth(gl_FragCoord.xy - centre);
    result = light_of(front.y / front_scale, back.y / back_scale, len, optics, optics);
#endif
}
)";

constexpr const char* near_cell_vertex_text = R"(
uniform vec2 low, high; // pixels from the image's centre
uniform float half_range;

void main()
{
    vec2 place = vec2((gl_VertexID & 1) == 0 ? low.x : high.x, (gl_VertexID & 2) == 0 ? low.y : high.y);
    gl_Position = vec4(place / half_range, 0.0, 1.0);
}
)";

constexpr const char* near_cell_text = R"(
uniform vec3 offsets[4], slopes[4];
uniform vec3 scalar_offset, scalar_slope;
uniform vec2 scalar_range;
uniform float first_depth; // where rays begin

void main()
{
    vec2 pixel = gl_FragCoord.xy - centre;
    vec3 place = vec3(pixel, 1.0);
    float first = first_depth;
    float last = 1e30;
    for (int i = 0; i < 4; ++i) {
        float offset = dot(offsets[i], place);
        float slope = dot(slopes[i], place);
        float depth = -offset / slope;
        if (slope < 0.0)
            first = max(first, depth);
        else if (slope > 0.0)
            last = min(last, depth);
        else if (offset > 0.0)
            last = first;
    }
    if (!(last > first))
        discard;
    float offset = dot(scalar_offset, place);
    float slope = dot(scalar_slope, place);
    float front = clamp(offset + slope * first, scalar_range.x, scalar_range.y);
    float back = clamp(offset + slope * last, scalar_range.x, scalar_range.y);
    float len = (last - first) * length_per_depth(pixel);
#ifdef OPTICS
    // Where a ray begins inside the cell there is no vertex whose colour could be taken.
    result = light_of(front, back, len, optics_at(front), optics_at(back));
#else
    result = light_of(front, back, len, vec4(0.0), vec4(0.0));
#endif
}
)";

} // namespace

ShaderPair triangle_shaders(Projector projector, Integrator integrator, bool perspective)
{
    std::string start = header(integrator);
    const std::string integrate = integrator_shader(integrator);
    switch (projector) {
    case Projector::silhouette: {
        const SilhouetteLayout layout(integrator);
        const bool passes = integrator == Integrator::exact;
        start += perspective ? "#define PERSPECTIVE\n" : "";
        start += passes ? "#define PASSES\n" : "";
        return {start + layout.vertex_shader(), start + result_text + layout.declarations() +
                                                    (passes ? optical_pass_shader() : integrate) + silhouette_text};
    }
    case Projector::thick:
        return {start + view_vertex_text + thick_vertex_text, start + result_text + view_text + integrate + thick_text};
    case Projector::thick_gpu:
        return {start + view_vertex_text + (needs_optics(integrator) ? optics_shader() : "") + thick_gpu_vertex_text,
                start + result_text + view_text + integrate + thick_text};
    case Projector::planes:
        return {start + view_vertex_text + (needs_optics(integrator) ? optics_shader() : "") + planes_vertex_text,
                start + result_text + view_text + integrate + planes_text};
    }
    return {};
}

ShaderPair near_cell_shaders(Integrator integrator)
{
    const std::string optics = needs_optics(integrator) ? optics_shader() : "";
    return {header(integrator) + near_cell_vertex_text,
            header(integrator) + result_text + near_ray_text + optics + integrator_shader(integrator) + near_cell_text};
}

} // namespace visorder
