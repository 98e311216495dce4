#include "projection/opengl/integrator_shaders.h"

namespace visorder::detail {

namespace {

constexpr const char* pieces_text = R"(
uniform samplerBuffer pieces;       // three texels each: see OpticalPieces
uniform isamplerBuffer first_piece;

int piece_at(float scalar)
{
    int parts = textureSize(first_piece);
    int piece = scalar < 0.0 ? 0 : texelFetch(first_piece, min(int(scalar * float(parts)), parts - 1)).r;
    while (scalar >= texelFetch(pieces, 3 * piece).y)
        ++piece;
    return piece;
}

vec4 optics_at(float scalar)
{
    int piece = piece_at(scalar);
    vec4 bounds = texelFetch(pieces, 3 * piece);
    float way = scalar - bounds.x;
    return vec4(texelFetch(pieces, 3 * piece + 1).rgb + way * texelFetch(pieces, 3 * piece + 2).rgb,
                bounds.z + way * bounds.w);
}
)";

// Extinction and colour are linear on each piece, so the optical depth t is quadratic, and by parts
//     integral of e c exp(-t) = c (1 - E) + d (M - (1 + E) / 2)
// with c the colour half way, d its change, M the mean of exp(-t) and E = exp(-t at the end). With t now that at the
// end and u half the difference of extinctions between the ends times the length,
//     M - (1 + E) / 2 = sqrt(E) (integral from -1/2 to 1/2 of exp(u (1/4 - v^2) - t v) dv - cosh(t / 2)),
// of which the second factor is even in t. The polynomials are least-squares fits, weighted for an even error over
// -1/4 < t < 1.15, |u| < |t|: 3e-8 t for 1 - E, 3e-7 t for the other; and one through Chebyshev's points for sqrt(E).
// Written so that no long chain of operations waits for each other.
constexpr const char* stretch_text = R"(
// 1 - E, and M - (1 + E) / 2.
vec2 shares_of(float t, float u)
{
    float tt = t * t;
    float opacity = t * ((1.0 - 0.5 * t) + tt * ((0.166668077 - 0.0416685826 * t) +
                    tt * ((0.00831463206 - 0.00133093150 * t) + tt * 0.000137367953)));
    float half_through = (1.0 - 0.500020018 * t) + tt * ((0.12498342 - 0.0205256859 * t) + tt * 0.00209010653);
    float even = -0.0833321983 + tt * (-0.00208585873 - tt * 1.74433759e-5);
    float odd = 0.166666691 + tt * (0.00416676258 + tt * 3.64243757e-5) +
                u * (0.0166643457 + tt * 0.000302037259 +
                u * (0.00119012823 + tt * 2.07597860e-5 + u * 6.73259096e-5));
    return vec2(opacity, half_through * (tt * even + u * odd));
}
)";

// A piece is passed in stretches of an optical depth of 1 at most. Light from behind 17 of them does not count, so that
// there are few of them however dense the medium is; where each ends is the root of a quadratic.
constexpr const char* piece_text = R"(
// d0 and d1: extinctions at the ends, times the piece's length.
void pass(inout vec4 light, inout float transmittance, float d0, float d1, vec3 c0, vec3 c1)
{
    const float most = 1e15; // squared, it is no infinity
    float first = clamp(d0, 0.0, most);
    float rise = clamp(d1, 0.0, most) - first;
    vec3 change = c1 - c0;
    float done = 0.0;
    while (transmittance > 4e-8) {
        float density = max(first + done * rise, 0.0);
        float way = 1.0 - done;
        float depth = way * (density + 0.5 * rise * way);
        bool last = depth <= 1.0;
        if (!last) {
            way = min(way, 2.0 / (density + sqrt(max(density * density + 2.0 * rise, 0.0))));
            depth = way * (density + 0.5 * rise * way);
        }
        vec2 shares = shares_of(min(depth, 1.15), 0.5 * rise * way * way);
        vec3 seen = shares.x * (c0 + (done + 0.5 * way) * change) + shares.y * way * change;
        light += transmittance * vec4(seen, shares.x);
        transmittance *= 1.0 - shares.x;
        done += way;
        if (last)
            break;
    }
}
)";

constexpr const char* exact_text = R"(
vec4 light_of(float front, float back, float len, vec4 front_optics, vec4 back_optics)
{
    vec4 light = vec4(0.0);
    float transmittance = 1.0;
    float rise = back - front;
    int piece = piece_at(front);
    float done = 0.0;
    for (;;) {
        vec4 bounds = texelFetch(pieces, 3 * piece);
        vec3 colour = texelFetch(pieces, 3 * piece + 1).rgb;
        vec3 colour_rise = texelFetch(pieces, 3 * piece + 2).rgb;
        float end = 1.0;
        if (rise > 0.0 && back > bounds.y)
            end = clamp((bounds.y - front) / rise, done, 1.0);
        if (rise < 0.0 && back < bounds.x)
            end = clamp((bounds.x - front) / rise, done, 1.0);
        float s0 = front + done * rise - bounds.x;
        float s1 = front + end * rise - bounds.x;
        float way = (end - done) * len;
        pass(light, transmittance, way * (bounds.z + s0 * bounds.w), way * (bounds.z + s1 * bounds.w),
             colour + s0 * colour_rise, colour + s1 * colour_rise);
        bool last = rise == 0.0 || (rise > 0.0 ? back <= bounds.y : back >= bounds.x);
        if (last || transmittance <= 4e-8)
            break;
        done = end;
        piece += rise > 0.0 ? 1 : -1;
    }
    return light;
}
)";

// The same where single precision is not enough; see OpticalPieces::Piece.
constexpr const char* exact_text_in_doubles = R"(
struct Piece {
    double begin, end, extinction, extinction_slope;
    vec4 colour, colour_slope;
};
layout(std430, binding = 2) readonly buffer Pieces { Piece pieces[]; };

int piece_at(double scalar)
{
    int low = 0, high = pieces.length() - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (scalar < pieces[middle].end)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

vec4 light_in_doubles(double front, double back, double len)
{
    vec4 light = vec4(0.0);
    float transmittance = 1.0;
    double rise = back - front;
    int piece = piece_at(front);
    double done = 0.0;
    for (;;) {
        double begin = pieces[piece].begin, end = pieces[piece].end;
        double extinction = pieces[piece].extinction, slope = pieces[piece].extinction_slope;
        double until = 1.0;
        if (rise > 0.0 && back > end)
            until = clamp((end - front) / rise, done, 1.0);
        if (rise < 0.0 && back < begin)
            until = clamp((begin - front) / rise, done, 1.0);
        double s0 = front + done * rise - begin;
        double s1 = front + until * rise - begin;
        double way = (until - done) * len;
        vec3 colour = pieces[piece].colour.rgb, colour_rise = pieces[piece].colour_slope.rgb;
        pass(light, transmittance, float(min(way * (extinction + s0 * slope), 1e30)),
             float(min(way * (extinction + s1 * slope), 1e30)), colour + float(s0) * colour_rise,
             colour + float(s1) * colour_rise);
        bool last = rise == 0.0 || (rise > 0.0 ? back <= end : back >= begin);
        if (last || transmittance <= 4e-8)
            break;
        done = until;
        piece += rise > 0.0 ? 1 : -1;
    }
    return light;
}
)";

// Of an OpticalPass: a part of the way cut out by its window, of an optical depth of 1 or little more.
//
// `backwards` is 1 / run. Written for renderers that have no branches and no min and max that are sure of what is no
// number.
constexpr const char* optical_pass_text = R"(
flat in float a_part; // of the way

float in_unit(float x)
{
    return clamp(x, 0.0, 1.0);
}

vec4 light_of_pass(float one, float run, float backwards, float len, float direction)
{
    // In parts of the way, from where this one begins.
    float parts = window.z;
    bool whole = window.x == window.y;
    float begin = in_unit((window.x - one) * (backwards * parts) - window.w);
    float end = in_unit((window.y - one) * (backwards * parts) - window.w);
    begin = whole ? 0.0 : begin;
    end = whole ? 1.0 : end;
    float share = in_unit(end - begin) * a_part;
    float middle = one + (0.5 * (begin + end) + window.w) * a_part * run;
    run *= direction * share;
    len *= share;

    float t = len * (medium.x + middle * medium_rise.x);
    float u = 0.5 * len * run * medium_rise.x;
    vec2 shares = shares_of(t, u);
    float opacity = shares.x;
    float colour_share = opacity * middle + run * shares.y;
    return vec4(medium.yzw * opacity + medium_rise.yzw * colour_share, opacity);
}
)";

constexpr const char* exponential_text = R"(
vec4 light_of(float front, float back, float len, vec4 front_optics, vec4 back_optics)
{
    vec4 mean = 0.5 * (front_optics + back_optics);
    float opacity = 1.0 - exp(-mean.w * len);
    return vec4(mean.rgb * opacity, opacity);
}
)";

// The table holds light per length, and extinction.
constexpr const char* preintegrated_3d_text = R"(
uniform sampler3D table;
uniform float length_scale;
uniform bool exponential_axis;

vec4 light_of(float front, float back, float len, vec4 front_optics, vec4 back_optics)
{
    float scaled = abs(len) * length_scale;
    vec3 size = vec3(textureSize(table, 0));
    vec3 place = vec3(front, back, exponential_axis ? 1.0 - exp2(-scaled) : scaled);
    vec4 density = texture(table, (place * (size - 1.0) + 0.5) / size);
    return vec4(density.rgb * len, 1.0 - exp(-density.a * len));
}
)";

constexpr const char* preintegrated_2d_text = R"(
uniform sampler2D table;
uniform float length_scale;

vec4 light_of(float front, float back, float len, vec4 front_optics, vec4 back_optics)
{
    vec2 size = vec2(textureSize(table, 0));
    vec4 unit = texture(table, (vec2(front, back) * (size - 1.0) + 0.5) / size);
    float scale = len * length_scale;
    // Linear in length, but no more than opaque.
    return unit * (unit.a * scale > 1.0 ? 1.0 / unit.a : scale);
}
)";

} // namespace

std::string optics_shader()
{
    return pieces_text;
}

std::string optical_pass_shader()
{
    return std::string(stretch_text) + optical_pass_text;
}

bool needs_optics(Integrator integrator)
{
    return integrator == Integrator::linear || integrator == Integrator::exponential;
}

std::string integrator_shader(Integrator integrator)
{
    switch (integrator) {
    case Integrator::linear:
    case Integrator::exponential:
        return exponential_text;
    case Integrator::preintegrated_2d:
        return preintegrated_2d_text;
    case Integrator::preintegrated_3d:
        return preintegrated_3d_text;
    case Integrator::exact:
        return std::string(pieces_text) + stretch_text + piece_text + exact_text;
    }
    return {};
}

std::string exact_shader_in_doubles()
{
    return std::string(stretch_text) + piece_text + exact_text_in_doubles;
}

} // namespace visorder::detail
