#include "natator/solver.h"

#include <algorithm>
#include <limits>
#include <set>

#include "base/text.h"
#include "model/background_pressure.h"
#include "model/water_volumes.h"
#include "stage.h"

namespace natator {
namespace {

bool is_limit(double value) {
    return value < static_cast<double>(std::numeric_limits<float>::max());
}

/// Can a pair that is not fluid-fluid (in scheme `conserving` one of solids) ever collide? Pairs of one group do only
/// with self_collide.
bool has_contacts(const Model& model) {
    std::set<std::uint32_t> groups;
    bool any_solid = false;
    bool any_self_collide = false;
    for (int i = 0; i < model.particles(); ++i) {
        if (model.scheme == Scheme::conserving && model.is_fluid(i)) continue;
        groups.insert(model.phase[i] & phase::group_mask);
        any_solid |= !model.is_fluid(i);
        any_self_collide |= (model.phase[i] & phase::self_collide) != 0;
    }
    return any_solid && (groups.size() > 1 || any_self_collide);
}

bool is_uniform_fluid(const Model& model) {
    std::set<std::uint32_t> fluid_phases;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i))
            fluid_phases.insert(model.phase[i] &
                                (phase::group_mask | phase::self_collide | phase::self_collide_filter));
    return fluid_phases.size() == 1 && (*fluid_phases.begin() & phase::self_collide) &&
           !(*fluid_phases.begin() & phase::self_collide_filter);
}

/// Description of how scheme conserving carries the water's weight.
std::string about_weight(const Model& model) {
    if (!model.parameters.conserving.modified_pressure) return "";
    return solved_depth(model) < depth(model)
               ? ", modified pressure"
               : ", modified pressure (carries nothing: the water is shallow or weightless)";
}

}  // namespace

Plan make_plan(const Model& model) {
    const SolverParameters& p = model.parameters;
    const auto is_fluid = [](std::uint32_t bits) { return (bits & phase::fluid) != 0; };
    const bool flex = model.scheme == Scheme::flex;
    Plan plan;
    plan.mutual_contacts = !flex;
    const bool any_fluid = std::any_of(model.phase.begin(), model.phase.end(), is_fluid);
    plan.water = !flex && any_fluid;
    plan.fluid = flex && any_fluid;
    plan.contacts = has_contacts(model);
    plan.solid_pressure = plan.fluid && plan.contacts && p.flex.solidPressure != 0;
    plan.uniform_fluid = plan.fluid && is_uniform_fluid(model);
    plan.springs = !model.springs.empty();
    plan.clusters = !model.clusters.empty();
    plan.planes = !model.planes.empty();
    plan.particle_friction =
        plan.contacts && p.dynamic_friction > 0 && (p.particle_friction > 0 || p.static_friction > 0);
    plan.plane_friction = plan.planes && p.dynamic_friction > 0;
    plan.viscosity = any_fluid && (flex ? p.flex.viscosity != 0 : p.conserving.kinematic_viscosity > 0);
    plan.damping = p.damping != 0;
    plan.clamp_acceleration = flex && is_limit(p.max_acceleration);
    plan.clamp_speed = is_limit(p.max_speed);
    plan.restitution = plan.planes && p.restitution > 0;
    plan.adhesion = plan.planes && p.adhesion > 0;
    plan.sleep = p.sleep_threshold > 0;
    plan.shock_propagation = plan.contacts && p.shock_propagation > 0 && !p.gravity.isZero();
    plan.dissipation = plan.contacts && p.dissipation > 0;
    plan.cohesion = any_fluid && p.cohesion > 0;
    plan.surface_tension = any_fluid && p.surface_tension > 0;
    plan.vorticity = any_fluid && p.vorticity_confinement > 0;
    plan.free_surface_drag = any_fluid && p.free_surface_drag > 0;
    plan.fluid_forces =
        plan.surface_tension || plan.vorticity || (plan.water && (plan.cohesion || plan.free_surface_drag));
    return plan;
}

Plan make_unskipped_plan(const Model& model) {
    const SolverParameters& p = model.parameters;
    Plan plan = make_plan(model);
    const bool frictionless = p.particle_friction <= 0 && p.static_friction <= 0;
    plan.contacts = plan.springs = plan.clusters = plan.planes = true;
    plan.uniform_fluid = false;
    plan.particle_friction |= frictionless;
    plan.plane_friction |= p.dynamic_friction <= 0 && p.static_friction <= 0;
    plan.damping = plan.clamp_speed = plan.sleep = plan.adhesion = plan.dissipation = true;
    plan.shock_propagation |= !p.gravity.isZero();
    plan.solid_pressure = plan.fluid;
    plan.viscosity = plan.cohesion = plan.surface_tension = plan.vorticity = plan.free_surface_drag =
        plan.fluid_forces = plan.fluid || plan.water;
    return plan;
}

std::vector<std::string> describe_plan(const Model& model) {
    const Plan plan = make_plan(model);
    const bool flex = model.scheme == Scheme::flex;
    std::vector<std::string> lines;
    const auto add = [&lines](bool needed, std::string line) {
        if (needed) lines.push_back(std::move(line));
    };
    add(!model.muscles.empty(),
        flex ? "per frame: actuate muscles" : "per substep: actuate muscles, with a start ramp");
    const auto once = [](const std::string& what) { return "per substep: " + what; };
    const auto each = [&](Stage stage, const char* kind = "") {
        return std::to_string(model.parameters.iterations) + " x per substep: " + kind + name(stage);
    };
    const auto each_of_solids = [&](Stage stage) {
        const int times = model.parameters.iterations * (flex ? 1 : model.parameters.conserving.solid_iterations);
        return std::to_string(times) + " x per substep: " + name(stage);
    };
    const auto forces = [&] {
        add(plan.free_surface_drag, once(name(Stage::free_surface_drag)));
        add(plan.cohesion && !flex, once(name(Stage::cohesion)));
        add(plan.surface_tension, once("surface tension"));
        add(plan.vorticity, once("vorticity confinement"));
    };
    add(model.water_box.has_value(), once("impulses of the water on the body"));
    add(plan.water, once("find fluid neighbours"));
    add(plan.water, once("density and gradients"));
    add(plan.water, once(name(Stage::overlaps)));
    add(plan.water, once(name(Stage::divergence)) + about_weight(model));
    add(plan.water && plan.viscosity, once(name(Stage::viscosity)));
    if (plan.water) forces();
    add(true, once(name(Stage::predict)));
    add(plan.fluid || plan.contacts, once("sort into cells"));
    add(plan.fluid, once(std::string("find fluid neighbours") + (plan.uniform_fluid ? "" : " (test per pair)")));
    add(plan.contacts, once("find contacts"));
    add(plan.planes, once("find plane contacts"));
    add(plan.fluid, each(Stage::density) + (plan.solid_pressure ? " with solid pressure" : ""));
    add(plan.fluid || plan.water, each(Stage::density_constraint));
    add(plan.cohesion && flex, each(Stage::cohesion));
    add(plan.contacts, each_of_solids(Stage::contacts) + (plan.particle_friction ? " with friction" : "") +
                           (plan.shock_propagation ? ", shock propagation" : ""));
    add(plan.springs, each_of_solids(Stage::springs));
    add(plan.clusters, each_of_solids(Stage::shape_matching));
    const bool local = model.parameters.flex.relaxationMode == RelaxationMode::local;
    add(flex, each(Stage::relaxation, local ? "local " : "global "));
    add(plan.planes, each_of_solids(Stage::planes) + (plan.plane_friction ? " with friction" : ""));
    add(plan.water, once(name(Stage::walls)));
    add(plan.water, once(name(Stage::water_motion)));
    std::string velocities = once(name(Stage::velocities));
    if (!flex && (plan.springs || plan.clusters)) velocities += ", body momentum";
    if (flex && plan.viscosity) velocities += ", viscosity";
    if (plan.damping) velocities += ", damping";
    if (plan.clamp_acceleration) velocities += ", acceleration clamp";
    if (plan.clamp_speed) velocities += ", speed clamp";
    add(true, velocities);
    add(plan.dissipation, once(name(Stage::dissipation)));
    if (flex) forces();
    add(plan.adhesion, once(name(Stage::adhesion)));
    add(plan.restitution, once(name(Stage::restitution)));
    add(plan.sleep, once(name(Stage::sleep)));
    add(true, once("check finite"));
    if (model.water_box) {
        const double eddies = model.water_box->smagorinsky;
        add(true, once("lattice: cells that the body covers, collision and streaming" +
                       (eddies > 0 ? ", eddies by Smagorinsky's constant " + number_text(eddies) : "")));
    }
    return lines;
}

}  // namespace natator
