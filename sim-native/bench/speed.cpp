#include "speed.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench_scenes.h"
#include "machine.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "scene/scene_json.h"
#include "statistics.h"

namespace natator::bench {
namespace {

struct NamedScene {
    const char* name;
    const char* scene;
    int scale;        ///< of the fluid block along each axis
    double duration;  ///< s
    int settling;     ///< updates, each about a substep's work
};

constexpr std::array known_scenes = {
    NamedScene{"creature-1", "thesis/creature-1", 1, 4, 100},
    NamedScene{"creature-2", "thesis/creature-2", 1, 4, 100},
    NamedScene{"creature-3", "thesis/creature-3", 1, 4, 100},
    NamedScene{"creature-4", "thesis/creature-4", 1, 4, 100},
    NamedScene{"vacuum", "thesis/creature-1-vacuum", 1, 4, 0},
    NamedScene{"fluid-x8", "thesis/creature-1", 2, 0.5, 12},
    NamedScene{"fluid-x64", "thesis/creature-1", 4, 0.1, 2},
    NamedScene{"open-water", "open-water/creature-2", 1, 1, 30},
};

Scene make_scene(const NamedScene& named, bool quick) {
    nlohmann::json overrides = {{"duration", quick ? 1.0 / 60 : named.duration},
                                {"settling", {{"updates", quick ? 1 : named.settling}}},
                                {"stopping", {{"planeContact", false}, {"noProgressAfter", 0}}}};
    if (named.scale > 1) {
        const int scale = named.scale;
        overrides.update(thesis_tank_with({scale * 50, scale * 7, scale * 17}, 0.09));
    }
    return load_scene(named.scene, overrides);
}

const NamedScene& find_scene(const std::string& name) {
    const auto found =
        std::find_if(known_scenes.begin(), known_scenes.end(), [&](const auto& scene) { return scene.name == name; });
    if (found != known_scenes.end()) return *found;
    throw InputError("unknown speed scene \"" + name + "\": must be one of " + joined(speed_scene_names(), ", "));
}

}  // namespace

std::string SpeedScene::text() const {
    return steps ? name + ' ' + steps->text() : name;
}

std::vector<SpeedScene> speed_scenes_at(const std::vector<std::string>& names,
                                        const std::vector<std::string>& settings) {
    std::vector<SpeedScene> scenes;
    for (const std::string& name : names) {
        if (settings.empty()) scenes.push_back({name});
        for (const std::string& setting : settings) scenes.push_back({name, steps_of(setting)});
    }
    return scenes;
}

Scene make_speed_scene(const SpeedScene& named, bool quick) {
    Scene scene = make_scene(find_scene(named.name), quick);
    if (named.steps) set_steps(*named.steps, scene.solver);
    return scene;
}

SpeedWork speed_work(const Scene& scene) {
    const Model model = build_model(scene);
    const int fluid = fluid_particles(model), iterations = model.parameters.iterations;
    const double substeps = std::round(scene.duration / scene.time_step) * model.parameters.substeps;
    return {
        {std::to_string(model.particles()), std::to_string(fluid), number_text(substeps), std::to_string(iterations)},
        (fluid > 0 ? fluid : model.particles()) * substeps * iterations};
}

Gait speed_gait(const Scene& scene) {
    if (scene.creature->name == "creature-1") return thesis_gait(1);
    if (scene.creature->name == "creature-2") return thesis_gait(2);
    Gait gait;
    gait.frequency = 1;
    const auto actuators = static_cast<std::size_t>(scene.creature->actuators());
    gait.amplitude.assign(actuators, 0.5);
    for (std::size_t k = 0; k < actuators; ++k)
        gait.phase.push_back(static_cast<double>(k) / static_cast<double>(actuators));
    return gait;
}

namespace {

/// One scene as it is computed, with what was measured so far.
struct TimedScene {
    Row key;
    Scene scene;
    Precision precision;
    int threads;
    std::vector<double> seconds{};
    std::string hash{};
    double peak_mb = 0;
    StageProfile profile{};
};

void measure(TimedScene& one) {
    using Clock = std::chrono::steady_clock;
    StageProfile profile;
    forget_peak_memory();
    const auto start = Clock::now();
    const Evaluation result =
        evaluate(one.scene, speed_gait(one.scene),
                 {.precision = one.precision, .execution = {.profile = &profile, .threads = one.threads}});
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (one.seconds.empty() || seconds < *std::min_element(one.seconds.begin(), one.seconds.end()))
        one.profile = profile;
    one.seconds.push_back(seconds);
    one.peak_mb = std::max(one.peak_mb, peak_memory_mb());
    const std::string hash = hash_text(result.hash);
    if (!one.hash.empty() && one.hash != hash)
        throw std::runtime_error(joined(one.key, " ") + ": two runs differ: " + one.hash + " and " + hash);
    one.hash = hash;
}

Row figures(const TimedScene& one) {
    const SpeedWork work = speed_work(one.scene);
    const double least = *std::min_element(one.seconds.begin(), one.seconds.end());
    return joined_rows(work.columns,
                       {std::to_string(one.seconds.size()), measured_text(least), measured_text(median(one.seconds)),
                        measured_text(1e-6 * work.particle_iterations / least), measured_text(one.peak_mb), one.hash});
}

}  // namespace

std::vector<std::string> speed_scene_names() {
    std::vector<std::string> names;
    for (const NamedScene& scene : known_scenes) names.emplace_back(scene.name);
    return names;
}

Row speed_columns() {
    return fields(
        "scene,scheme,precision,instruction_set,threads,machine,particles,fluid_particles,substeps,"
        "iterations,repeats,seconds_least,seconds_median,million_particle_iterations_per_second,peak_mb,"
        "hash");
}

Row speed_profile_columns() {
    return fields("scene,scheme,precision,instruction_set,threads,machine,stage,calls,seconds,share");
}

void run_speed_study(const SpeedStudy& study, ResultTable& table, ResultTable& profile,
                     const std::function<void(const std::string&)>& report) {
    const std::string machine = machine_text();
    for (const SpeedScene& named : study.scenes) {
        std::vector<TimedScene> timed;
        for (const Scheme scheme : study.schemes) {
            for (const Precision precision : study.precisions) {
                for (const int threads : study.threads) {
                    const Row key{named.text(),
                                  to_string(scheme),
                                  to_string(precision),
                                  to_string(instruction_set()),
                                  std::to_string(threads),
                                  machine};
                    if (table.has(key)) continue;
                    Scene scene = make_speed_scene(named, study.quick);
                    scene.scheme = scheme;
                    timed.push_back({key, std::move(scene), precision, threads});
                }
            }
        }
        for (int repeat = 0; repeat < study.repeats; ++repeat)
            for (TimedScene& one : timed) measure(one);
        for (const TimedScene& one : timed) {
            table.add(joined_rows(one.key, figures(one)));
            report(joined(table.rows().back(), " "));
            for (const StageProfile::Entry& entry : one.profile.entries())
                profile.add(
                    joined_rows(one.key, {entry.stage, std::to_string(entry.calls), measured_text(entry.seconds),
                                          measured_text(entry.seconds / one.profile.seconds())}));
        }
    }
}

}  // namespace natator::bench
