#include "projection/silhouette_layout.h"

#include "projection/integrator_shaders.h"

#include <fmt/format.h>

namespace visorder {

SilhouetteLayout::SilhouetteLayout(Integrator integrator, bool passes)
{
    const auto add = [&](std::initializer_list<const char*> names) {
        for (const char* const name : names)
            names_[count_++] = name;
    };
    add({"tents"});
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
                                       "layout(location = {}) in vec4 last_head;\n"
                                       "flat out vec4 place;\n"
                                       "flat out vec2 beside;\n",
                                       a_corner_, 2 * a_corner_);
    std::string body = "    gl_Position = vec4(head.xy, 0.0, 1.0);\n"
                       "    place = vec4(head.zw, next_head.zw);\n"
                       "    beside = last_head.zw;\n";
    for (std::size_t i = 0; i < count_; ++i) {
        declared +=
            fmt::format("layout(location = {0}) in vec4 {1}_given;\nflat out vec4 {1};\n", location(i), names_[i]);
        body += fmt::format("    {0} = {0}_given;\n", names_[i]);
    }
    const char* const view = R"(
#if defined PERSPECTIVE && !defined LINEAR
uniform vec3 ray_constant, ray_quadratic; // of the length of rays, squared, over gl_FragCoord
flat out vec3 ray0, ray2;
#endif
)";
    const char* const hand_on_view = R"(
#if defined PERSPECTIVE && !defined LINEAR
    ray0 = ray_constant;
    ray2 = ray_quadratic;
#endif
)";
    return declared + view + "void main()\n{\n" + body + hand_on_view + "}\n";
}

std::string SilhouetteLayout::declarations() const
{
    std::string text = "flat in vec4 place;\nflat in vec2 beside;\n";
    for (const char* const name : names())
        text += fmt::format("flat in vec4 {};\n", name);
    return text;
}

} // namespace visorder
