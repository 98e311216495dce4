#include "projection/opengl/projector_shaders.h"

#include "projection/opengl/blending_image.h"
#include "projection/opengl/integrator_shaders.h"
#include "projection/opengl/packed_place.h"
#include "projection/opengl/silhouette_layout.h"
#include "projection/opengl/thick_vertex_shader.h"

#include <fmt/format.h>

namespace visorder::detail {

namespace {

std::string header(Integrator integrator, bool software)
{
    std::string text = fmt::format("#version 450 core\n#define PLACE_OFFSET {}.0\n", PackedPlace::offset);
    if (software)
        text += "#define CHANNELS_APART\n";
    if (needs_optics(integrator))
        text += "#define OPTICS\n";
    if (integrator == Integrator::linear)
        text += "#define LINEAR\n";
    return text;
}

constexpr const char* planes_vertex_text = R"(
struct Triangle {
    vec4 place, tents_high, tents_low, tent_offsets, shape, depth, scalar;
    vec2 corners[4];
#ifdef OPTICS
    vec4 optics[4];
#endif
};
layout(std430, binding = 1) readonly buffer Triangles { Triangle triangles[]; };
uniform float half_range;

flat out vec4 place, tents_high, tents_low, tent_offsets, shape, depth, scalar;
#ifdef OPTICS
flat out vec4 optics[4];
#endif

void main()
{
    int triangle = gl_VertexID / 3;
    place = triangles[triangle].place;
    tents_high = triangles[triangle].tents_high;
    tents_low = triangles[triangle].tents_low;
    tent_offsets = triangles[triangle].tent_offsets;
    shape = triangles[triangle].shape;
    depth = triangles[triangle].depth;
    scalar = triangles[triangle].scalar;
#ifdef OPTICS
    for (int i = 0; i < 4; ++i)
        optics[i] = triangles[triangle].optics[i];
#endif
    hand_on_view();
    // Dividing by a power of two is exact, and the viewport multiplies again.
    gl_Position = vec4(triangles[triangle].corners[gl_VertexID - 3 * triangle] / half_range, 0.0, 1.0);
}
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

// See PlaneTriangles and SplitLinear. In units of the way where the cell is thickest, faces are passed at
//     0,  1 - t1,  1 - t2,  1 - t3     of a triangle: the face of the outer points, and the three others;
//     t2,  opposite t2,  1 - t1,  1 - t3     of a quad: the faces at the nearer edge, and those at the farther one.
constexpr const char* planes_text = R"(
flat in vec4 place, tents_high, tents_low, tent_offsets, shape, depth, scalar;
#ifdef OPTICS
flat in vec4 optics[4];
#endif

void main()
{
    vec2 pixel = gl_FragCoord.xy - centre;
    vec2 p = pixel + PLACE_OFFSET - abs(place.xy);
    precise float high1 = tents_high.x * p.x + tents_high.y * p.y + tent_offsets.x;
    precise float high2 = tents_high.z * p.x + tents_high.w * p.y + tent_offsets.y;
    precise float t1 = high1 + (tents_low.x * p.x + tents_low.y * p.y + tent_offsets.z);
    precise float t2 = high2 + (tents_low.z * p.x + tents_low.w * p.y + tent_offsets.w);
    bool quad = place.x < 0.0;
    float t3 = shape.x * t1 + shape.y * t2;
    float first = quad ? max(t2, shape.z * t2) : 0.0;
    float last = min(min(1.0 - t1, 1.0 - t3), quad ? 1.0 - t1 : 1.0 - t2);
    if (last <= first)
        discard;
    vec2 base = vec2(depth.x + depth.y * t1 + depth.z * t2, scalar.x + scalar.y * t1 + scalar.z * t2);
    vec2 rise = vec2(depth.w, scalar.w);
    vec2 one = base + rise * first;
    vec2 other = base + rise * last;
    // Scalars are linear in space: on the screen, they are when multiplied by 1 - depth * inverse_distance.
    float one_scale = 1.0 / (1.0 - one.x * inverse_distance);
    float other_scale = 1.0 / (1.0 - other.x * inverse_distance);
    float len = abs(depth.w) * (last - first) * one_scale * other_scale * length_per_depth(pixel);
    float one_scalar = one.y * one_scale;
    float other_scalar = other.y * other_scale;
    bool swapped = place.y < 0.0;
#ifdef OPTICS
    vec4 base_optics = optics[0] + optics[1] * t1 + optics[2] * t2;
    vec4 one_optics = (base_optics + optics[3] * first) * one_scale;
    vec4 other_optics = (base_optics + optics[3] * last) * other_scale;
#else
    vec4 one_optics = vec4(0.0), other_optics = vec4(0.0);
#endif
    put(light_of(swapped ? other_scalar : one_scalar, swapped ? one_scalar : other_scalar, len,
                 swapped ? other_optics : one_optics, swapped ? one_optics : other_optics));
}
)";

// See Thickness and SilhouetteLayout. Along the ray the scalar runs from `one` to `one + run`.
constexpr const char* silhouette_text = R"(
flat in vec3 place;
#ifdef ROWS
noperspective in float row;
#endif
#ifdef PERSPECTIVE
flat in vec3 ray0, ray2; // of the length of rays, squared: constant and linear, quadratic
#endif

void main()
{
#ifdef ROWS
    vec2 p = vec2(gl_FragCoord.x, floor(row)) + place.xy;
#else
    vec2 p = gl_FragCoord.xy + place.xy;
#endif
    // See SplitLinear.
    precise float high1 = tents_high.x * p.x + tents_high.y * p.y + tent_offsets.x;
    precise float high2 = tents_high.z * p.x + tents_high.w * p.y + tent_offsets.y;
    precise float t1 = high1 + (tents_low.x * p.x + tents_low.y * p.y + tent_offsets.z);
    precise float t2 = high2 + (tents_low.z * p.x + tents_low.w * p.y + tent_offsets.w);
    float g = t2 * (t2 > 0.0 ? 1.0 - shape.w : shape.z);
    float m = max(max(t1, shape.x * t1 + shape.y * t2), shape.w * t2);
    float thickness = 1.0 - g - m;
    // The triangle drawn reaches beyond the cell.
    bool in_cell = thickness > 0.0;
#ifdef LINEAR
    vec3 colour = colour0.rgb + colour1.rgb * t1 + colour2.rgb * t2 + colour3.rgb * g + colour4.rgb * m;
    float alpha = in_cell ? colour0.w * thickness : 0.0;
    put(vec4(colour * alpha, alpha));
#else
#ifdef OPTICS
    vec4 optics = colour0 + colour1 * t1 + colour2 * t2 + colour3 * g + colour4 * m;
#endif
    float one = rises.z + slopes.x * t1 + slopes.y * t2;
#ifdef PERSPECTIVE
    // Back from what is linear on the screen.
    float one_scale = 1.0 + slopes.z * t1 + slopes.w * t2;
    float rise = (rises.y * one_scale - rises.w * one) * thickness;
    one_scale += rises.w * g;
    float other_scale = one_scale + rises.w * thickness;
    float both_scales = one_scale * other_scale;
    float scale = 1.0 / both_scales;
    one = (one + rises.y * g) * other_scale * scale;
    float run = rise * scale;
    float len = rises.x * thickness * scale *
                sqrt(ray0.x + (ray0.y + ray2.x * p.x + ray2.y * p.y) * p.x + (ray0.z + ray2.z * p.y) * p.y);
#else
    float rise = rises.y * thickness;
    float both_scales = 1.0;
    one += rises.y * g;
    float run = rise;
    float len = rises.x * thickness;
#endif
#ifdef PASSES
    // Of a rise so small that it does not count either way, not divided by zero.
    vec4 light = light_of_pass(one, run, both_scales / (rise + 1e-30), len, place.z);
#else
#ifndef OPTICS
    vec4 optics = vec4(0.0);
#endif
    bool swapped = place.z < 0.0;
    vec4 light = light_of(swapped ? one + run : one, swapped ? one : one + run, len, optics, optics);
#endif
    put(in_cell ? light : vec4(0.0));
#endif
}
)";

// Of the records of near cells, see record_of: an instance is one of them.
constexpr const char* near_cell_record_text = R"(
layout(std430, binding = 3) readonly buffer NearCells { double numbers[]; };
const int record_numbers = 28;
)";

constexpr const char* near_cell_vertex_text = R"(
uniform int first_record;
uniform float half_range;
flat out int record; // the place of its first number

void main()
{
    record = (first_record + gl_InstanceID) * record_numbers;
    vec2 low = vec2(numbers[record + 24], numbers[record + 25]); // pixels from the image's centre
    vec2 high = vec2(numbers[record + 26], numbers[record + 27]);
    vec2 place = vec2((gl_VertexID & 1) == 0 ? low.x : high.x, (gl_VertexID & 2) == 0 ? low.y : high.y);
    gl_Position = vec4(place / half_range, 0.0, 1.0);
}
)";

// See NearCell.
constexpr const char* near_cell_text = R"(
flat in int record;

dvec2 values[4];
dvec3 from_ray[4];

double area(int i, int k)
{
    return from_ray[i].x * from_ray[k].y - from_ray[k].x * from_ray[i].y;
}

// On which side of the edge the ray passes. One that meets it is moved aside by (e, e^2), with e little.
bool is_left(int i, int k)
{
    dvec3 a = from_ray[i], b = from_ray[k];
    double forth = a.x * b.y, back = b.x * a.y;
    if (forth != back)
        return forth > back;
    forth = b.z * a.y;
    back = a.z * b.y;
    if (forth != back)
        return forth > back;
    return a.z * b.x >= b.z * a.x;
}

// Depth and scalar where the ray meets a face.
dvec2 met(int i, int j, int k)
{
    dvec3 weights = abs(dvec3(area(j, k), area(k, i), area(i, j)));
    double sum = weights.x + weights.y + weights.z;
    if (sum == 0.0) {
        weights = dvec3(1.0);
        sum = 3.0;
    }
    return (weights.x * values[i] + weights.y * values[j] + weights.z * values[k]) / sum;
}

void main()
{
    vec2 pixel = gl_FragCoord.xy - centre;
    for (int i = 0; i < 4; ++i) {
        dvec3 place = dvec3(numbers[record + 3 * i], numbers[record + 3 * i + 1], numbers[record + 3 * i + 2]);
        from_ray[i] = dvec3(place.x - pixel.x * place.z, place.y - pixel.y * place.z, place.z);
        values[i] = dvec2(numbers[record + 12 + 2 * i], numbers[record + 13 + 2 * i]);
    }
    dvec2 scalar_range = dvec2(numbers[record + 20], numbers[record + 21]);
    double first_depth = numbers[record + 22], inverse_depth = numbers[record + 23];
    bool left01 = is_left(0, 1), left02 = is_left(0, 2), left03 = is_left(0, 3);
    bool left12 = is_left(1, 2), left13 = is_left(1, 3), left23 = is_left(2, 3);
    dvec2 one = dvec2(0.0), other = dvec2(0.0);
    int count = 0, opposite = 0;
    if (left12 == left23 && left12 != left13) {
        one = met(1, 2, 3);
        opposite = 0;
        ++count;
    }
    if (left02 == left23 && left02 != left03) {
        other = one;
        one = met(0, 2, 3);
        opposite = 1;
        ++count;
    }
    if (left01 == left13 && left01 != left03) {
        other = one;
        one = met(0, 1, 3);
        opposite = 2;
        ++count;
    }
    if (left01 == left12 && left01 != left02) {
        other = one;
        one = met(0, 1, 2);
        opposite = 3;
        ++count;
    }
    if (count == 0)
        discard;
    // A ray from one of the cell's points passes the face opposite alone: there the cell begins.
    if (count == 1) {
        if (from_ray[opposite] != dvec3(0.0))
            discard;
        other = values[opposite];
    }
    dvec2 enter = one.x < other.x ? one : other;
    dvec2 leave = one.x < other.x ? other : one;
    double first = max(enter.x, first_depth);
    if (!(leave.x > first))
        discard;
    double way = (first - enter.x) / (leave.x - enter.x);
    double first_scale = 1.0 / (1.0 - first * inverse_depth);
    double last_scale = 1.0 / (1.0 - leave.x * inverse_depth);
    double front = clamp((enter.y + way * (leave.y - enter.y)) * first_scale, scalar_range.x, scalar_range.y);
    double back = clamp(leave.y * last_scale, scalar_range.x, scalar_range.y);
    double len = (leave.x - first) * first_scale * last_scale * double(length_per_depth(pixel));
#ifdef OPTICS
    // Where a ray begins inside the cell there is no vertex whose colour could be taken.
    put(light_of(float(front), float(back), float(len), optics_at(float(front)), optics_at(float(back))));
#elif defined(EXACT)
    put(light_in_doubles(front, back, len));
#else
    put(light_of(float(front), float(back), float(len), vec4(0.0), vec4(0.0)));
#endif
}
)";

} // namespace

bool interpolates_rows(Projector projector, bool software)
{
    return software && projector == Projector::silhouette;
}

ShaderPair triangle_shaders(Projector projector, Integrator integrator, bool perspective, bool software)
{
    std::string start = header(integrator, software);
    if (projector == Projector::planes)
        return {start + view_vertex_text + planes_vertex_text,
                start + BlendingImage::shader_text() + view_text + integrator_shader(integrator) + planes_text};
    const bool in_shader = projector == Projector::thick_gpu;
    const bool passes = integrator == Integrator::exact && !in_shader;
    const SilhouetteLayout layout(integrator, passes);
    start += perspective && integrator != Integrator::linear ? "#define PERSPECTIVE\n" : "";
    start += passes ? "#define PASSES\n" : "";
    start += interpolates_rows(projector, software) ? "#define ROWS\n" : "";
    return {start + (in_shader ? thick_vertex_shader() : layout.vertex_shader()),
            start + BlendingImage::shader_text() + layout.declarations() +
                (passes ? optical_pass_shader() : integrator_shader(integrator)) + silhouette_text};
}

ShaderPair near_cell_shaders(Integrator integrator, bool software)
{
    const std::string optics = needs_optics(integrator) ? optics_shader() : "";
    const bool exact = integrator == Integrator::exact;
    const std::string start = header(integrator, software) + (exact ? "#define EXACT\n" : "");
    return {start + near_cell_record_text + near_cell_vertex_text,
            start + near_cell_record_text + BlendingImage::shader_text() + near_ray_text + optics +
                (exact ? exact_shader_in_doubles() : integrator_shader(integrator)) + near_cell_text};
}

} // namespace visorder::detail
