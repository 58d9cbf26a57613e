#include "stability_axes.h"

#include <algorithm>

#include "io/strict_json.h"
#include "natator/error.h"
#include "scene/scene_json.h"

namespace natator::bench {
namespace {

/// Shocks act on the bare start: settling would take them away before time 0.
void start_unsettled(StabilityCase& subject) {
    subject.scene.settling.updates = 0;
}

void set_stiffness(StabilityCase& subject, double stiffness) {
    subject.scene.creature->cluster_stiffness = stiffness;
    subject.scene.creature->spring_stiffness = stiffness;
}

/// The fluid's masses are 1 in the calm case.
void set_mass_ratio(StabilityCase& subject, double ratio) {
    subject.scene.creature->particle_mass = ratio;
}

void set_overlap(StabilityCase& subject, double spacing_factor) {
    start_unsettled(subject);
    subject.scene.fluid->spacing *= spacing_factor;
}

/// Puts every other of the first 2 `pairs` fluid particles exactly where the one before it is.
void set_coincident(StabilityCase& subject, double pairs) {
    start_unsettled(subject);
    subject.rearrange = [pairs](Model& model) {
        const int first = static_cast<int>(model.body.particles.size());
        const int last = std::min(model.particles(), first + 2 * static_cast<int>(pairs));
        for (int i = first + 1; i < last; i += 2) model.position[i] = model.position[i - 1];
    };
}

/// Puts 20 fluid particles of the tank's right end `distance` behind its wall.
void set_outside(StabilityCase& subject, double distance) {
    start_unsettled(subject);
    subject.rearrange = [distance](Model& model) {
        const double wall = -model.planes[3].offset * model.planes[3].normal.x();
        const int count = model.particles();
        for (int i = std::max(0, count - 20); i < count; ++i) model.position[i].x() = wall + distance;
    };
}

/// r_r / r_f at the thesis' r_f and lattice; bodies touch at their rest distance, or at r_r if that is less.
void set_radius_ratio(StabilityCase& subject, double ratio) {
    SolverParameters& solver = subject.scene.solver;
    solver.radius = ratio * solver.fluidRestDistance;
    solver.solidRestDistance = std::min(solver.solidRestDistance, solver.radius);
}

std::vector<StabilityAxis> make_axes() {
    using Case = StabilityCase;
    std::vector<StabilityAxis> axes;
    const auto add = [&axes](std::string name, std::string meaning, std::vector<double> values,
                             std::vector<double> quick, std::function<void(Case&, double)> set) {
        axes.push_back({std::move(name), std::move(meaning), std::move(values), std::move(quick), std::move(set)});
    };
    add("dt", "factor on the time step of 1/60 s at 4 substeps", {0.25, 0.5, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32}, {1, 32},
        [](Case& c, double v) { c.scene.time_step *= v; });
    add("substeps", "substeps per frame", {1, 2, 3, 4, 6, 8, 12, 16, 24, 32}, {1, 4},
        [](Case& c, double v) { c.scene.solver.substeps = static_cast<int>(v); });
    add("iterations", "iterations per substep", {1, 2, 3, 4, 6, 8, 12, 16, 24, 32}, {1, 4},
        [](Case& c, double v) { c.scene.solver.numIterations = static_cast<int>(v); });
    add("mass-ratio", "mass of a body particle over that of a fluid particle",
        {1e-4, 1e-3, 1e-2, 0.1, 0.3, 1, 3, 10, 100, 1e3, 1e4}, {1e-4, 1e4}, set_mass_ratio);
    add("stiffness", "stiffness of clusters and springs", {0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.99, 1},
        {0, 1}, set_stiffness);
    add("frequency", "of the muscles, 1/s", {0.5, 1, 2, 4, 8, 15, 30, 45, 60}, {60},
        [](Case& c, double v) { c.gait.frequency = v; });
    add("amplitude", "of all muscles", {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2}, {2},
        [](Case& c, double v) { std::fill(c.gait.amplitude.begin(), c.gait.amplitude.end(), v); });
    add("gravity", "factor on 10 length/s^2", {0, 0.1, 0.3, 1, 3, 10, 30, 100}, {100},
        [](Case& c, double v) { c.scene.solver.gravity *= v; });
    add("overlap", "factor on the fluid's spacing at the start", {1, 0.9, 0.8, 0.7, 0.5, 0.25, 0.1, 0.01}, {0.5},
        set_overlap);
    add("coincident", "pairs of fluid particles in one place at the start", {1, 5, 20, 100, 300}, {100},
        set_coincident);
    add("body-clearance", "distance of the fluid from the body at the start, length", {0.15, 0.1, 0.05, 0.01, 0}, {0},
        [](Case& c, double v) {
            start_unsettled(c);
            c.scene.fluid->clearance = v;
        });
    add("outside", "start of 20 fluid particles behind a wall, length", {0.01, 0.1, 0.5, 1, 10, 100, 1e4}, {1},
        set_outside);
    add("radius-ratio", "r_r / r_f; 1 itself is refused", {1.0001, 1.01, 1.05, 1.1, 1.2, 1.3, 1.5, 1.75, 2, 2.5, 3},
        {1.0001, 3}, set_radius_ratio);
    add("viscosity", "1/s", {0, 1, 8, 30, 100, 300, 1e3, 3e3, 1e4}, {1e4},
        [](Case& c, double v) { c.scene.solver.viscosity = v; });
    add("relaxation", "omega, local relaxation", {0.1, 0.2, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2}, {0.1, 2},
        [](Case& c, double v) { c.scene.solver.relaxationFactor = v; });
    return axes;
}

}  // namespace

StabilityCase calm_case() {
    StabilityCase result;
    result.scene = load_scene("bench/small-tank");
    result.gait.frequency = 1.861;
    result.gait.amplitude = {0.973, 0.690};
    result.gait.phase = {0, 0.648};
    return result;
}

const std::vector<StabilityAxis>& stability_axes() {
    static const std::vector<StabilityAxis> axes = make_axes();
    return axes;
}

const std::vector<StabilityMap>& stability_maps() {
    static const std::vector<StabilityMap> maps = {
        {"dt", "iterations", {0.25, 0.5, 1, 2, 4, 8, 16, 32}, {1, 2, 4, 8, 16}},
        {"dt", "stiffness", {0.25, 0.5, 1, 2, 4, 8, 16, 32}, {0, 0.1, 0.2, 0.5, 0.8, 1}},
    };
    return maps;
}

const StabilityAxis& stability_axis(const std::string& name) {
    std::string known;
    for (const StabilityAxis& axis : stability_axes()) {
        if (axis.name == name) return axis;
        known += (known.empty() ? "" : ", ") + axis.name;
    }
    throw InputError("--axis = " + quoted(name) + ": must be one of " + known);
}

}  // namespace natator::bench
