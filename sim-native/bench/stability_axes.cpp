#include "stability_axes.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "natator/error.h"
#include "scene/scene_json.h"

namespace natator::bench {
namespace {

/// Shocks act on the bare start: settling would take them away before time 0.
void start_unsettled(StabilityCase& subject) {
    subject.scene.settling.updates = 0;
}

void for_each_creature(StabilityCase& subject, const std::function<void(Creature&)>& change) {
    change(*subject.scene.creature);
    for (Companion& companion : subject.scene.companions) change(companion.creature);
}

void for_each_gait(StabilityCase& subject, const std::function<void(Gait&)>& change) {
    change(subject.gait);
    for (Companion& companion : subject.scene.companions) change(companion.gait);
}

void set_stiffness(StabilityCase& subject, double stiffness) {
    for_each_creature(subject, [stiffness](Creature& creature) {
        creature.cluster_stiffness = creature.spring_stiffness = stiffness;
    });
}

/// The fluid's masses are 1 in the calm case.
void set_mass_ratio(StabilityCase& subject, double ratio) {
    for_each_creature(subject, [ratio](Creature& creature) { creature.particle_mass = ratio; });
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

/// Puts 20 fluid particles of the tank's right end `distance` behind its wall. That breaks the law `tank` on purpose,
/// so it is judged from half of the run on: the wall has to have taken them back by then, and they must have no more
/// energy than they began with.
void set_outside(StabilityCase& subject, double distance) {
    const std::vector<Plane>& planes = subject.scene.planes;
    const auto right =
        std::find_if(planes.begin(), planes.end(), [](const Plane& plane) { return plane.normal.x() == -1; });
    if (!subject.scene.periodic.empty() || right == planes.end())
        throw InputError("axis outside: needs a wall at the tank's right end");
    start_unsettled(subject);
    subject.judged_from = 0.5;
    subject.rearrange = [distance, wall = right->offset](Model& model) {
        const int count = model.particles();
        for (int i = std::max(0, count - 20); i < count; ++i) model.position[i].x() = wall + distance;
    };
}

/// r_r / r_f at the thesis' r_f and lattice; bodies touch at their rest distance, or at r_r if that is less.
void set_radius_ratio(StabilityCase& subject, double ratio) {
    SolverParameters& solver = subject.scene.solver;
    solver.radius = ratio * solver.fluid_rest_distance;
    solver.solid_rest_distance = std::min(solver.solid_rest_distance, solver.radius);
}

template <class Named>
const Named& named(const std::vector<Named>& all, const std::string& name, const std::string& option) {
    std::string known;
    for (const Named& one : all) {
        if (one.name == name) return one;
        known += (known.empty() ? "" : ", ") + one.name;
    }
    throw InputError(option + " = " + quoted(name) + ": must be one of " + known);
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
    add("iterations", "iterations per substep", {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128}, {1, 128},
        [](Case& c, double v) { c.scene.solver.iterations = static_cast<int>(v); });
    add("mass-ratio", "mass of a body particle over that of a fluid particle",
        {1e-4, 1e-3, 1e-2, 0.1, 0.3, 1, 3, 10, 100, 1e3, 1e4}, {1e-4, 1e4}, set_mass_ratio);
    add("stiffness", "stiffness of clusters and springs", {0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.99, 1},
        {0, 1}, set_stiffness);
    add("frequency", "of the muscles, 1/s", {0.5, 1, 2, 4, 8, 15, 30, 45, 60}, {60},
        [](Case& c, double v) { for_each_gait(c, [v](Gait& gait) { gait.frequency = v; }); });
    add("amplitude", "of all muscles", {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2}, {2}, [](Case& c, double v) {
        for_each_gait(c, [v](Gait& gait) { std::fill(gait.amplitude.begin(), gait.amplitude.end(), v); });
    });
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
        [](Case& c, double v) { c.scene.solver.flex.viscosity = v; });
    add("relaxation", "omega, local relaxation", {0.1, 0.2, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2}, {0.1, 2},
        [](Case& c, double v) { c.scene.solver.relaxation_factor = v; });
    return axes;
}

}  // namespace

const std::vector<StabilityScene>& stability_scenes() {
    static const std::vector<StabilityScene> scenes = {
        {"small-tank", "as it is", "{}"},
        {"moving-tank", "longer by 0.9, goes along with its swimmer in steps of 0.01",
         R"({"planes": [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [-1, 0, 0, 2.44], [0, 0, -1, 0.82]], "fluid": {"count": [27, 7, 9]},
             "creature": {"rearCentre": [0.92, 0.42, 0.41]}, "movingTank": {"along": "x", "step": 0.01}})",
         true},
        {"periodic-tank", "closes up with itself along x",
         R"({"planes": [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [-1, 0, 0, 1.53], [0, 0, -1, 0.82]], "periodic": ["x"]})",
         true},
        {"obstacle", "a ball stands before the swimmer",
         R"({"obstacles": [{"shape": "sphere", "centre": [1.25, 0.42, 0.41], "radius": 0.12}]})"},
        {"companion", "longer by 0.9, a second swimmer ahead that beats half a period apart",
         R"({"planes": [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [-1, 0, 0, 2.44], [0, 0, -1, 0.82]], "fluid": {"count": [27, 7, 9]},
             "companions": [{"creature": {"name": "short-swimmer", "slices": [{"height": 3, "width": 3, "count": 9}],
                                          "joints": [2, 4, 6], "rearCentre": [1.42, 0.42, 0.41]},
                             "gait": {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0.5, 0.148]}}]})"},
        {"modified-pressure", "solver.modifiedPressure", R"({"solver": {"modifiedPressure": true}})", true},
        {"far", "100 units from the origin along x, y and z",
         R"({"planes": [[0, 1, 0, -100], [0, 0, 1, -100], [1, 0, 0, -100], [-1, 0, 0, 101.54], [0, 0, -1, 100.82]],
             "fluid": {"origin": [100.05, 100.05, 100.05]}, "creature": {"rearCentre": [100.42, 100.42, 100.41]}})"},
        {"large-tank", "300 000 particles, 30 deep",
         R"({"planes": [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [-1, 0, 0, 9.01], [0, 0, -1, 9.01]],
             "fluid": {"count": [100, 30, 100]}, "creature": {"rearCentre": [4.2, 1.4, 4.5]}})"},
    };
    return scenes;
}

const StabilityScene& stability_scene(const std::string& name) {
    return named(stability_scenes(), name, "--scene");
}

StabilityCase calm_case(const StabilityScene& scene) {
    nlohmann::json overrides = nlohmann::json::parse(scene.overrides);
    if (scene.conserving_only) overrides["scheme"] = "conserving";
    StabilityCase result;
    result.scene = load_scene("bench/small-tank", overrides);
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
        {"dt", "iterations", {0.5, 1, 2, 4, 8, 16, 32}, {1, 2, 4, 8, 16, 48, 128}},
        {"dt", "stiffness", {0.25, 0.5, 1, 2, 4, 8, 16, 32}, {0, 0.1, 0.2, 0.5, 0.8, 1}},
        {"iterations", "stiffness", {1, 4, 16, 64, 128}, {0, 0.2, 0.5, 0.8, 1}},
        {"gravity", "mass-ratio", {0, 1, 3, 10, 30, 100}, {1e-4, 1e-2, 0.3, 1, 10, 100, 1e4}},
        {"frequency", "amplitude", {1, 2, 4, 8, 15, 30, 60}, {0.25, 0.5, 1, 1.5, 2}},
        {"overlap", "iterations", {1, 0.9, 0.7, 0.5, 0.25, 0.1}, {1, 4, 16, 48, 128}},
    };
    return maps;
}

const StabilityAxis& stability_axis(const std::string& name) {
    return named(stability_axes(), name, "--axis");
}

}  // namespace natator::bench
