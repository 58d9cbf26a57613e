#include "periodic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <sstream>

#include "base/text.h"
#include "natator/error.h"
#include "tank_ends.h"
#include "water_volumes.h"

namespace natator {
namespace {

constexpr double along = 1e-9;  // cosine of a plane's normal with an axis that it is along

template <class... Parts>
[[noreturn]] void refuse(const Scene& scene, const Parts&... parts) {
    std::ostringstream text;
    text << "scene " << quoted(scene.name) << ": periodic: ";
    (text << ... << parts);
    throw InputError(text.str());
}

/// Of the body at rest, whichever way it turns.
double max_side(const Model& model) {
    Eigen::AlignedBox3d box;
    for (const int i : model.body.particles) box.extend(model.position[i]);
    return model.body.particles.empty() ? 0 : box.sizes().maxCoeff();
}

/// Nothing may be near both ends of anything else: only one ghost of a particle counts, and a body does not meet
/// itself.
void check_room(const Scene& scene, const Model& model, const PeriodicAxis& axis) {
    const double reach = 2 * support(model), body = max_side(model), length = axis.length();
    const char* const name = name_of_axis(axis.axis);
    if (!(length >= reach))
        refuse(scene, "the tank is ", length, " long along ", name, "; must be at least ", reach,
               " (two kernel radii of kernelSupport x fluidRestDistance)");
    if (body > 0 && length < body + reach)
        refuse(scene, "the body is ", body, " long, and the tank along ", name, ' ', length, "; must be at least ",
               body + reach, " (the body and two kernel radii)");
}

void check_planes(const Scene& scene, const PeriodicAxis& axis) {
    for (const Plane& plane : scene.planes) {
        if (std::abs(plane.normal[axis.axis]) <= along) continue;
        const Eigen::Vector3d& n = plane.normal;
        refuse(scene, "plane [", n.x(), ", ", n.y(), ", ", n.z(), ", ", plane.offset, "] is not along ",
               name_of_axis(axis.axis), "; all but the two at the ends must be");
    }
}

void check_starts(const Scene& scene, const Model& model, const PeriodicAxis& axis) {
    for (const Eigen::Vector3d& at : model.position) {
        if (at[axis.axis] >= axis.low && at[axis.axis] <= axis.high) continue;
        refuse(scene, "particle at (", at.x(), ", ", at.y(), ", ", at.z(), ") is outside the tank; must begin within [",
               axis.low, ", ", axis.high, "] along ", name_of_axis(axis.axis));
    }
}

/// Solids at both ends are at one place: nothing may lie there twice.
void check_ends(const Scene& scene, const Model& model, const PeriodicAxis& axis) {
    const double near = 1e-6 * axis.length();
    using Across = std::array<std::int64_t, 2>;
    const auto across = [&](const Eigen::Vector3d& at) {
        return Across{std::llround(at.y() / near), std::llround(at[2 - axis.axis] / near)};
    };
    std::set<Across> low;
    for (int i = 0; i < model.particles(); ++i)
        if (!model.is_fluid(i) && model.position[i][axis.axis] - axis.low < near) low.insert(across(model.position[i]));
    for (int i = 0; i < model.particles(); ++i) {
        const Eigen::Vector3d& at = model.position[i];
        if (model.is_fluid(i) || axis.high - at[axis.axis] >= near || !low.contains(across(at))) continue;
        refuse(scene, "obstacles have a particle at (", at.x(), ", ", at.y(), ", ", at.z(), "), at the high end along ",
               name_of_axis(axis.axis),
               ", and one just there at the low end, which is the same place; one that goes all along must be a "
               "spacing shorter than the tank");
    }
}

}  // namespace

void check_periodic(const Scene& scene, const Model& model) {
    if (scene.periodic.empty()) return;
    if (scene.scheme == Scheme::flex)
        refuse(scene, "scheme = \"flex\": must be \"conserving\" or \"lattice\", whose water alone closes up");
    if (!scene.companions.empty() || (scene.creature && !scene.obstacles.empty()))
        refuse(scene, "has no room for a creature beside ", scene.companions.empty() ? "obstacles" : "companions",
               ", as contacts of solids do not reach through the ends");
    for (const PeriodicAxis& axis : scene.periodic) {
        if (axis.axis != 0 && axis.axis != 2) refuse(scene, "axis ", axis.axis, "; must be 0 (x) or 2 (z)");
        const auto same = [&](const PeriodicAxis& other) { return other.axis == axis.axis; };
        if (std::count_if(scene.periodic.begin(), scene.periodic.end(), same) > 1)
            refuse(scene, name_of_axis(axis.axis), " is there twice; must be once");
        check_planes(scene, axis);
        check_room(scene, model, axis);
        check_starts(scene, model, axis);
        check_ends(scene, model, axis);
    }
}

}  // namespace natator
