#include "projection/opengl/silhouette_layout.h"

#include "projection/opengl/integrator_shaders.h"

#include <fmt/format.h>
#include <initializer_list>

namespace visorder::detail {

SilhouetteLayout::SilhouetteLayout(Integrator integrator, bool passes) : passes_(passes)
{
    const auto add = [&](std::initializer_list<const char*> names) {
        for (const char* const name : names)
            names_[count_++] = name;
    };
    add({"tents_high", "tents_low", "tent_offsets"});
    // Opacities that are interpolated hold lengths and scalars already.
    if (integrator != Integrator::linear)
        add({"rises", "slopes"});
    if (passes)
        add({"medium", "medium_rise", "window"});
    if (needs_optics(integrator))
        add({"colour0", "colour1", "colour2", "colour3", "colour4"});
    a_corner_ = 1 + static_cast<int>((count_ + 2) / 3);
}

int SilhouetteLayout::location(std::size_t vector) const
{
    const auto rest = static_cast<std::size_t>(a_corner_ - 1);
    return static_cast<int>(vector / rest) * a_corner_ + 1 + static_cast<int>(vector % rest);
}

std::string SilhouetteLayout::vertex_shader() const
{
    std::string declared = fmt::format("layout(location = 0) in vec4 head;\n"
                                       "layout(location = {}) in vec4 next_head;\n"
                                       "layout(location = {}) in vec4 last_head;\n",
                                       a_corner_, 2 * a_corner_);
    std::string body = "    gl_Position = vec4(head.xy, 0.0, 1.0);\n"
                       "    shape = vec4(next_head.zw, last_head.zw);\n"
                       "    hand_on_place(head.zw);\n";
    for (std::size_t i = 0; i < count_; ++i) {
        declared +=
            fmt::format("layout(location = {0}) in vec4 {1}_given;\nflat out vec4 {1};\n", location(i), names_[i]);
        body += fmt::format("    {0} = {0}_given;\n", names_[i]);
    }
    if (passes_) {
        declared += "flat out float a_part;\n";
        body += "    a_part = 1.0 / window_given.z;\n";
    }
    return declared + "flat out vec4 shape;\n" + place_vertex_shader() + "void main()\n{\n" + body + "}\n";
}

std::string SilhouetteLayout::declarations() const
{
    std::string text = "flat in vec4 shape;\n";
    for (const char* const name : names())
        text += fmt::format("flat in vec4 {};\n", name);
    return text;
}

// Software renderers gather what turns gl_FragCoord.y upside down for each fragment, and do better with a row that is
// interpolated and then rounded: in the middle of a pixel it is half a number but for rounding.
std::string place_vertex_shader()
{
    return R"(
flat out vec3 place; // takes gl_FragCoord.x and row or gl_FragCoord.y to pixels from the PackedPlace; and its sign
uniform vec2 centre; // of the image, pixels
#ifdef ROWS
uniform float half_range;
noperspective out float row;
#endif
#ifdef PERSPECTIVE
uniform vec3 ray_constant, ray_quadratic; // of the length of rays, squared, over pixels from the centre
flat out vec3 ray0, ray2;                 // likewise, from the place
#endif

// Only what is given for a triangle's first corner counts.
void hand_on_place(vec2 given)
{
    place = vec3(PLACE_OFFSET - abs(given), sign(given.y));
#ifdef ROWS
    place.y += 0.5;
    row = gl_Position.y * half_range + centre.y;
#endif
#ifdef PERSPECTIVE
    vec2 p = abs(given) - PLACE_OFFSET - centre;
    vec2 along = ray_constant.yz + vec2(2.0 * ray_quadratic.x, ray_quadratic.y) * p.x +
                 vec2(ray_quadratic.y, 2.0 * ray_quadratic.z) * p.y;
    ray0 = vec3(ray_constant.x + 0.5 * dot(ray_constant.yz + along, p), along);
    ray2 = ray_quadratic;
#endif
}
)";
}

} // namespace visorder::detail
