#include "visorder/renderer.h"

#include "visorder/error.h"

#include <array>
#include <fmt/format.h>
#include <string>

namespace visorder {

namespace {

template <class Kind>
Kind named(std::span<const Kind> kinds, const char* what, std::string_view wanted)
{
    std::string names;
    for (const Kind kind : kinds) {
        if (wanted == name(kind))
            return kind;
        names += names.empty() ? "" : ", ";
        names += name(kind);
    }
    throw InputError(fmt::format("no {} \"{}\"; there are: {}", what, wanted, names));
}

} // namespace

const char* name(Projector projector)
{
    switch (projector) {
    case Projector::silhouette:
        return "silhouette";
    case Projector::planes:
        return "planes";
    case Projector::thick:
        return "thick";
    case Projector::thick_gpu:
        return "thick-gpu";
    }
    return "";
}

const char* name(Integrator integrator)
{
    switch (integrator) {
    case Integrator::linear:
        return "linear";
    case Integrator::exponential:
        return "exponential";
    case Integrator::preintegrated_2d:
        return "preintegrated-2d";
    case Integrator::preintegrated_3d:
        return "preintegrated-3d";
    case Integrator::exact:
        return "exact";
    }
    return "";
}

std::span<const Projector> projectors()
{
    static constexpr std::array<Projector, 4> all{Projector::silhouette, Projector::planes, Projector::thick,
                                                  Projector::thick_gpu};
    return all;
}

std::span<const Integrator> integrators()
{
    static constexpr std::array<Integrator, 5> all{Integrator::linear, Integrator::exponential,
                                                   Integrator::preintegrated_2d, Integrator::preintegrated_3d,
                                                   Integrator::exact};
    return all;
}

Projector projector_named(std::string_view wanted)
{
    return named(projectors(), "projector", wanted);
}

Integrator integrator_named(std::string_view wanted)
{
    return named(integrators(), "integrator", wanted);
}

} // namespace visorder
