#include "bench_scenes.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/fluid_block.h"
#include "natator/error.h"
#include "natator/model.h"
#include "scene/scene_json.h"

namespace natator::bench {
namespace {

Subject from_scene(const std::string& scene_name, const Gait& gait = {}) {
    const Scene scene = load_scene(scene_name);
    return {.name = "", .model = build_model(scene), .gait = gait, .settling = scene.settling};
}

/// A cube of 5 x 5 x 5 fluid particles, 0.3 above the pool's surface.
Subject falling_drop() {
    Subject subject = from_scene("bench/pool");
    FluidBlock drop;
    drop.count = {5, 5, 5};
    drop.spacing = 0.1;
    drop.origin = {0.5, 0.75, 0.5};
    drop.gradient = MassGradient::uniform;
    drop.bottom_mass = 1;
    add_fluid(drop, subject.model);
    return subject;
}

/// 20 particles joined by 19 inextensible springs, the first held in place, let go at 45 degrees.
Subject hanging_chain() {
    constexpr int links = 19;
    constexpr double length = 0.1;
    const Eigen::Vector3d direction = Eigen::Vector3d(1, -1, 0).normalized();
    Subject subject;
    subject.settling.updates = 0;
    Model& model = subject.model;
    for (int i = 0; i <= links; ++i) {
        model.position.push_back(i * length * direction);
        model.velocity.push_back(Eigen::Vector3d::Zero());
        model.inverse_mass.push_back(i == 0 ? 0 : 1);
        model.phase.push_back(1);
        if (i > 0) model.springs.push_back({.a = i - 1, .b = i, .rest_length = length, .stiffness = 1});
    }
    return subject;
}

Subject bending_body() {
    Subject subject = from_scene("thesis/creature-1-vacuum", thesis_gait(1));
    subject.isolated = true;
    return subject;
}

struct NamedSubject {
    const char* name;
    Subject (*make)();
};

constexpr std::array subjects = {
    NamedSubject{"tank-creature-1", [] { return from_scene("thesis/creature-1", thesis_gait(1)); }},
    NamedSubject{"tank-creature-2", [] { return from_scene("thesis/creature-2", thesis_gait(2)); }},
    NamedSubject{"dam-break", [] { return from_scene("bench/dam-break"); }},
    NamedSubject{"falling-drop", falling_drop},
    NamedSubject{"hanging-chain", hanging_chain},
    NamedSubject{"bending-body", bending_body},
};

}  // namespace

std::vector<std::string> subject_names() {
    std::vector<std::string> names;
    for (const NamedSubject& subject : subjects) names.emplace_back(subject.name);
    return names;
}

Subject make_subject(const std::string& name) {
    for (const NamedSubject& entry : subjects) {
        if (entry.name != name) continue;
        Subject subject = entry.make();
        subject.name = name;
        return subject;
    }
    std::string known;
    for (const std::string& one : subject_names()) known += (known.empty() ? "" : ", ") + one;
    throw InputError("unknown bench scene \"" + name + "\": must be one of " + known);
}

int fluid_particles(const Model& model) {
    int fluid = 0;
    for (int i = 0; i < model.particles(); ++i) fluid += model.is_fluid(i);
    return fluid;
}

nlohmann::json thesis_tank_with(const std::array<int, 3>& count, double spacing) {
    constexpr double margin = 0.05;
    const auto wall = [&](int axis) { return 2 * margin + spacing * (count[axis] - 1); };
    nlohmann::json overrides;
    overrides["fluid"] = {{"count", count}, {"spacing", spacing}};
    overrides["planes"] = {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {-1, 0, 0, wall(0)}, {0, 0, -1, wall(2)}};
    return overrides;
}

Gait thesis_gait(int creature) {
    Gait gait;
    if (creature == 1) {
        gait.frequency = 1.861;
        gait.amplitude = {0.973, 0.690};
        gait.phase = {0, 0.648};
        return gait;
    }
    if (creature != 2) throw InputError("creature " + std::to_string(creature) + ": must be 1 or 2");
    gait.frequency = 1.338;
    constexpr int actuators = 8;
    for (int i = 0; i < actuators; ++i) {
        const double turns = 0.862 * i;
        gait.amplitude.push_back(std::lerp(0.504, 0.184, i / (actuators - 1.0)));
        gait.phase.push_back(turns - std::floor(turns));
    }
    return gait;
}

}  // namespace natator::bench
