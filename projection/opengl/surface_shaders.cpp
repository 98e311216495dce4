#include "projection/opengl/surface_shaders.h"

#include "projection/opengl/blending_image.h"

namespace visorder::detail {

namespace {

// Three vertices a triangle; all that is known of the triangle goes with them.
constexpr const char* vertex_text = R"(
struct Triangle {
    vec2 corners[3];
    double edges[9];
    float scalars[3];
    uint unused;
};
layout(std430, binding = 1) readonly buffer Triangles { Triangle triangles[]; };
uniform float half_range;

flat out dvec3 edge_0, edge_1, edge_2;
#ifdef SCALARS
flat out vec3 scalars;
#endif

void main()
{
    int t = gl_VertexID / 3;
    edge_0 = dvec3(triangles[t].edges[0], triangles[t].edges[1], triangles[t].edges[2]);
    edge_1 = dvec3(triangles[t].edges[3], triangles[t].edges[4], triangles[t].edges[5]);
    edge_2 = dvec3(triangles[t].edges[6], triangles[t].edges[7], triangles[t].edges[8]);
#ifdef SCALARS
    scalars = vec3(triangles[t].scalars[0], triangles[t].scalars[1], triangles[t].scalars[2]);
#endif
    // Dividing by a power of two is exact, and the viewport multiplies again.
    gl_Position = vec4(triangles[t].corners[gl_VertexID - 3 * t] / half_range, 0.0, 1.0);
}
)";

// See SurfaceTriangles. What is off the triangle adds nothing.
constexpr const char* fragment_text = R"(
uniform vec2 centre;  // of the image, pixels
uniform float hidden; // of what is behind, a part

flat in dvec3 edge_0, edge_1, edge_2;

double at(dvec3 edge, dvec2 pixel)
{
    precise double along_y = edge.y * pixel.y;
    precise double along_x = edge.x * pixel.x;
    precise double both = along_x + along_y;
    precise double sum = both + edge.z;
    return sum;
}

bool is_inside(dvec3 edge, double value)
{
    return value > 0.0lf ||
           (value == 0.0lf && (edge.x > 0.0lf || (edge.x == 0.0lf && edge.y > 0.0lf)));
}
)";

constexpr const char* flat_text = R"(
uniform vec3 colour;

vec3 colour_at(dvec3 weights) { return colour; }
)";

// The last point at or below the scalar, and the one after it: see TransferFunction::at.
constexpr const char* scalars_text = R"(
struct Point {
    double scalar;
    float red, green, blue;
    uint unused;
};
layout(std430, binding = 2) readonly buffer Points { Point points[]; };

flat in vec3 scalars;

vec3 colour_of(int i) { return vec3(points[i].red, points[i].green, points[i].blue); }

vec3 colour_at(dvec3 weights)
{
    // So that a scalar that is the same at all corners is so in between.
    dvec2 part = weights.yz / (weights.x + weights.y + weights.z);
    double first = double(scalars.x);
    double scalar = first + part.x * (double(scalars.y) - first) + part.y * (double(scalars.z) - first);
    int low = 0;                // the number of points that are known to be at or below it,
    int high = points.length(); // and of those that may be
    while (low < high) {
        int middle = (low + high) / 2;
        if (points[middle].scalar <= scalar)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == 0)
        return colour_of(0);
    if (low == points.length())
        return colour_of(low - 1);
    double before = points[low - 1].scalar;
    return mix(colour_of(low - 1), colour_of(low), float((scalar - before) / (points[low].scalar - before)));
}
)";

constexpr const char* main_text = R"(
void main()
{
    dvec2 pixel = dvec2(gl_FragCoord.xy - centre);
    dvec3 weights = dvec3(at(edge_0, pixel), at(edge_1, pixel), at(edge_2, pixel));
    bool inside = is_inside(edge_0, weights.x) && is_inside(edge_1, weights.y) && is_inside(edge_2, weights.z);
    put(inside ? vec4(hidden * colour_at(weights), hidden) : vec4(0.0));
}
)";

std::string header(SurfaceColouring colouring)
{
    return std::string("#version 450 core\n") + (colouring == SurfaceColouring::scalars ? "#define SCALARS\n" : "");
}

} // namespace

std::string surface_vertex_shader(SurfaceColouring colouring)
{
    return header(colouring) + vertex_text;
}

std::string surface_fragment_shader(SurfaceColouring colouring, bool channels_apart)
{
    return header(colouring) + (channels_apart ? "#define CHANNELS_APART\n" : "") + BlendingImage::shader_text() +
           fragment_text + (colouring == SurfaceColouring::scalars ? scalars_text : flat_text) + main_text;
}

} // namespace visorder::detail
