#include "projection/integrator_shaders.h"

namespace visorder {

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
//     integral of e c exp(-t) = c0 (1 - E) + (c1 - c0) (M - E),   M = mean of exp(-t), E = exp(-t at the end).
// M comes from Gauss's rule with three points over stretches of an optical depth of about 1.5 at most, on which it is
// right to 1e-5.
constexpr const char* exact_text = R"(
void pass(inout vec3 light, inout float transmittance, float len, float e0, float e1, vec3 c0, vec3 c1)
{
    float whole = 0.5 * (e0 + e1) * len;
    int parts = int(clamp(ceil(abs(whole) * (1.0 / 1.5)), 1.0, 64.0));
    float step = 1.0 / float(parts);
    float rise = (e1 - e0) * step;
    vec3 change = (c1 - c0) * step;
    len *= step;
    for (int i = 0; i < parts; ++i) {
        float a = -len * (e0 + float(i) * rise);
        float b = -0.5 * len * rise;
        float end = exp(a + b);
        float mean = (5.0 * (exp(0.1127016654 * (a + b * 0.1127016654)) + exp(0.8872983346 * (a + b * 0.8872983346))) +
                      8.0 * exp(0.5 * (a + b * 0.5))) * (1.0 / 18.0);
        light += transmittance * ((c0 + float(i) * change) * (1.0 - end) + change * (mean - end));
        transmittance *= end;
    }
}

vec4 light_of(float front, float back, float len, vec4 front_optics, vec4 back_optics)
{
    vec3 light = vec3(0.0);
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
        pass(light, transmittance, (end - done) * len, bounds.z + s0 * bounds.w, bounds.z + s1 * bounds.w,
             colour + s0 * colour_rise, colour + s1 * colour_rise);
        bool last = rise == 0.0 || (rise > 0.0 ? back <= bounds.y : back >= bounds.x);
        if (last)
            break;
        done = end;
        piece += rise > 0.0 ? 1 : -1;
    }
    return vec4(light, 1.0 - transmittance);
}
)";

// As above, for an OpticalPass: a part of the way cut out by its window, of an optical depth t of 1 or little more.
// With u half the difference of extinctions between its ends times its length,
//     M - (1 + E) / 2 = sqrt(E) (integral from -1/2 to 1/2 of exp(u (1/4 - v^2) - t v) dv - cosh(t / 2)),
// of which the second factor is even in t. The polynomials are least-squares fits, weighted for an even error over
// -1/4 < t < 1.15, |u| < |t|: 3e-8 t for 1 - E, 3e-7 t for the other; and one through Chebyshev's points for sqrt(E).
//
// `backwards` is 1 / run. Written for renderers that have no branches and no min and max that are sure of what is no
// number, and so that no long chain of operations waits for each other.
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
    // More is only in cells that are opaque many times over (see find_optical_passes), and stays opaque.
    u = t > 1.15 ? 0.0 : u;
    t = t > 1.15 ? 1.15 : t;
    float tt = t * t;
    float opacity = t * ((1.0 - 0.5 * t) + tt * ((0.166668077 - 0.0416685826 * t) +
                    tt * ((0.00831463206 - 0.00133093150 * t) + tt * 0.000137367953)));
    float half_through = (1.0 - 0.500020018 * t) + tt * ((0.12498342 - 0.0205256859 * t) + tt * 0.00209010653);
    float even = -0.0833321983 + tt * (-0.00208585873 - tt * 1.74433759e-5);
    float odd = 0.166666691 + tt * (0.00416676258 + tt * 3.64243757e-5) +
                u * (0.0166643457 + tt * 0.000302037259 +
                u * (0.00119012823 + tt * 2.07597860e-5 + u * 6.73259096e-5));
    float colour_share = opacity * middle + run * half_through * (tt * even + u * odd);
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
    return optical_pass_text;
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
        return std::string(pieces_text) + exact_text;
    }
    return {};
}

} // namespace visorder
