#include <algorithm>
#include <memory>
#include <sstream>

#include "base/text.h"
#include "commands.h"
#include "commit.h"
#include "json_argument.h"
#include "model/tank_ends.h"
#include "natator/batch.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/gait.h"
#include "natator/instruction_set.h"
#include "natator/model.h"
#include "natator/settled_state_cache.h"
#include "natator/solver.h"
#include "natator/version.h"
#include "physics/constants.h"
#include "run/swim_record.h"
#include "scene/gait_json.h"
#include "scene/scene_json.h"

namespace natator::cli {
namespace {

using nlohmann::ordered_json;

struct InfoOptions {
    std::string scene, overrides;
    bool json = false, definition = false, gait_template = false;
};

ordered_json describe_program() {
    const std::optional<SettledStateCache> starts = SettledStateCache::of_user();
    ordered_json devices = ordered_json::array();
    for (const Device& device : cuda_devices())
        devices.push_back(std::to_string(device.index) + ": " + device.name + ", compute capability " +
                          device.capability + ", " + std::to_string(device.memory >> 20) + " MiB");
    return {{"version", NATATOR_VERSION},
            {"commit", commit()},
            {"instructionSet", to_string(instruction_set())},
            {"schemas", (data_directory() / "protocol").string()},
            {"startCache", starts ? starts->folder().string() : "none"},
            {"devices", devices},
            {"scenes", scene_names()}};
}

/// Particles of the body that fit_to_water has made heavier than the scene has them.
int particles_made_heavier(const Scene& scene, const Model& model) {
    int count = 0;
    if (model.water_box) return count;
    for (const int i : model.body.particles)
        count += model.inverse_mass[i] < (1 - 1e-9) / scene.creature->particle_mass * scene.creature->parts();
    return count;
}

/// Which actuators bend which way; empty where all bend sideways.
std::string describe_bends(const Creature& creature) {
    int number[3] = {0, 0, 0};  // by Bend
    for (const Actuator& one : creature.actuator_list()) ++number[static_cast<int>(one.bend)];
    const auto span = [](int first, int count) {
        return std::to_string(first) + (count > 1 ? " to " + std::to_string(first + count - 1) : "");
    };
    const char* const words[3] = {" sideways", " up and down", " contract"};
    std::string text;
    for (int bend = 0, first = 0; bend < 3; first += number[bend++])
        if (number[bend] > 0) text += (text.empty() ? "" : ", ") + span(first, number[bend]) + words[bend];
    return number[0] == creature.actuators() ? "" : text;
}

ordered_json describe_skin(const Creature& creature, const Model& model) {
    const Skin& skin = *creature.skin;
    const double spacing = creature.spacing / creature.refinement;
    const double particles = static_cast<double>(model.body.particles.size()) * spacing * spacing * spacing;
    std::ostringstream text;
    text << skin.file << ", " << skin.triangles.size() << " triangles, a unit is " << skin.unit << ", volume "
         << skin.volume << ", of the particles " << particles;
    return text.str();
}

std::string describe_periodic(const Scene& scene) {
    std::ostringstream text;
    for (const PeriodicAxis& periodic : scene.periodic)
        text << (text.tellp() > 0 ? ", " : "") << name_of_axis(periodic.axis) << " from " << periodic.low << " to "
             << periodic.high;
    return text.str();
}

ordered_json describe_scene(const Scene& scene) {
    const Model model = build_model(scene);
    const SwimRecord tasks(scene, model);  // refuses a moving tank and goals that can't be
    const auto body = model.body.particles.size();
    ordered_json info;
    info["scene"] = scene.name;
    info["description"] = scene.description;
    info["creature"] = scene.creature ? ordered_json(scene.creature->name) : ordered_json();
    info["actuators"] = model.actuators;
    info["particles"] = model.particles();
    info["fluidParticles"] =
        std::count_if(model.phase.begin(), model.phase.end(), [](auto phase) { return phase & phase::fluid; });
    info["bodyParticles"] = body;
    if (!model.companions.empty()) info["companions"] = model.companions.size();
    if (!scene.obstacles.empty()) info["obstacles"] = scene.obstacles.size();
    info["bodyLength"] = model.body.length;
    const double across = water_across(model);
    if (across > 0) info["across"] = across;
    if (const std::string warning = warning_of_across(across); !warning.empty()) info["warning"] = warning;
    if (model.water_box) {
        const Eigen::Vector3i& cells = model.water_box->cells;
        info["cells"] = {cells.x(), cells.y(), cells.z()};
    }
    if (scene.creature) {
        if (const std::string bends = describe_bends(*scene.creature); !bends.empty()) info["bends"] = bends;
        if (scene.creature->joint == Joint::line) info["joint"] = "line";
        if (scene.creature->skin) info["mesh"] = describe_skin(*scene.creature, model);
    }
    if (scene.scheme == Scheme::flex && !model.clusters.empty()) info["leastSpacing"] = physics::min_flex_spacing;
    info["springs"] = model.springs.size();
    info["clusters"] = model.clusters.size();
    info["planes"] = model.planes.size();
    if (!scene.periodic.empty()) info["periodic"] = describe_periodic(scene);
    if (scene.moving_tank) info["movingTank"] = scene.moving_tank->along_z ? "along x and z" : "along x";
    if (!scene.goals.empty()) {
        info["goals"] = ordered_json::array();
        for (const Goal& goal : scene.goals) info["goals"].push_back(to_string(goal.measure));
    }
    info["duration"] = scene.duration;
    info["timeStep"] = scene.time_step;
    info["scheme"] = to_string(scene.scheme);
    info["substeps"] = model.parameters.substeps;
    if (model.parameters.substeps != scene.solver.substeps) info["substepsAsked"] = scene.solver.substeps;
    if (const int raised = particles_made_heavier(scene, model)) info["madeHeavier"] = raised;
    info["iterations"] = scene.solver.iterations;
    info["plan"] = describe_plan(model);
    return info;
}

/// People get numbers without the rounding of their computation, 1.35 for 18 x 0.075; --json has all of it.
std::string as_text_of_one(const ordered_json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return "none";
    return value.is_number_float() ? computed_text(value.get<double>()) : value.dump();
}

/// One "key  value" line per entry; lists one item per line.
std::string as_text(const ordered_json& info) {
    constexpr std::size_t column = 16;
    std::ostringstream text;
    for (const auto& [key, value] : info.items()) {
        const std::string label = key + std::string(key.size() < column ? column - key.size() : 1, ' ');
        if (value.is_array()) {
            for (std::size_t i = 0; i < value.size(); ++i) {
                text << (i == 0 ? label : std::string(column, ' ')) << as_text_of_one(value[i]) << '\n';
            }
        } else {
            text << label << as_text_of_one(value) << '\n';
        }
    }
    return text.str();
}

/// One key a line, a list on one.
std::string by_lines(const ordered_json& numbers) {
    std::string text;
    for (const auto& [key, value] : numbers.items()) {
        text += (text.empty() ? "{\n  " : ",\n  ") + ordered_json(key).dump() + ": ";
        for (const char c : value.dump()) text += c == ',' ? std::string(", ") : std::string(1, c);
    }
    return text + "\n}\n";
}

std::string gait_template(const Scene& scene, bool on_one_line) {
    build_model(scene);  // refuses a body whose muscles can't be
    if (!scene.creature || scene.creature->actuators() == 0)
        throw InputError("--gait-template: scene " + quoted(scene.name) + " has no muscles to drive: " +
                         (scene.creature ? "an actuator needs two joints" : "it has no creature"));
    ordered_json gait = gait_json(wave_gait(*scene.creature));
    gait.erase("power");
    return on_one_line ? gait.dump() + "\n" : by_lines(gait);
}

void run_info(const InfoOptions& options) {
    if (options.scene.empty() && !options.overrides.empty()) throw InputError("--overrides: needs a scene");
    if (options.scene.empty() && options.definition) throw InputError("--definition: needs a scene");
    if (options.scene.empty() && options.gait_template) throw InputError("--gait-template: needs a scene");
    const nlohmann::json overrides = read_overrides_argument(options.overrides);
    if (options.definition) {
        load_scene(options.scene, overrides);  // refuses what is wrong
        print(scene_definition(options.scene, overrides).dump(options.json ? -1 : 2) + "\n");
        return;
    }
    if (options.gait_template) {
        print(gait_template(load_scene(options.scene, overrides), options.json));
        return;
    }
    const ordered_json info =
        options.scene.empty() ? describe_program() : describe_scene(load_scene(options.scene, overrides));
    print(options.json ? info.dump() + "\n" : as_text(info));
}

}  // namespace

void add_info(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand(
        "info", "Describe a scene: particles, constraints, the plan of a step. Without one: version and named scenes.");
    const auto options = std::make_shared<InfoOptions>();
    command->add_option("scene", options->scene, "Name or path of the scene.");
    command->add_flag("--json", options->json, "Write one JSON object.");
    auto* definition =
        command->add_flag("--definition", options->definition,
                          "Write the scene itself: with its bases, its creature and the overrides merged.");
    command
        ->add_flag(
            "--gait-template", options->gait_template,
            "Write a gait to begin with for the scene's muscles, a wave from head to tail; for run and evaluate.")
        ->excludes(definition);
    command->add_option("--overrides", options->overrides, "File or JSON text merged into the scene (RFC 7386).");
    command->callback([options, &status] {
        run_info(*options);
        status = ok;
    });
}

}  // namespace natator::cli
