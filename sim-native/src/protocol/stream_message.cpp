#include <bit>

#include "base/strict_json.h"
#include "message_writer.h"
#include "model/boundaries.h"
#include "model/skin_weights.h"
#include "model/tank_ends.h"
#include "natator/error.h"
#include "natator/instruction_set.h"
#include "natator/measure.h"
#include "natator/version.h"
#include "protocol/stream.h"
#include "run/conservation_errors.h"
#include "scene/gait_json.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "messages are written as numbers are in memory");

constexpr std::uint32_t flag_running = 1, flag_touches_plane = 2;

ordered_json planes_json(const Model& model) {
    ordered_json planes = ordered_json::array();
    for (const Plane& plane : model.planes)
        planes.push_back({plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset});
    return planes;
}

/// {"x": [low, high]} of the axes that have no ends.
ordered_json periodic_json(const Model& model) {
    ordered_json periodic = ordered_json::object();
    for (const PeriodicAxis& axis : model.periodic) periodic[name_of_axis(axis.axis)] = {axis.low, axis.high};
    return periodic;
}

/// All places; of the water in a periodic tank, which is as well so many lengths of the tank away, those around the
/// swimmer.
template <class Real>
std::vector<Vector3<Real>> places_around_body(const Model& model, const State<Real>& state) {
    std::vector<Vector3<Real>> places = state.position;
    if (model.periodic.empty() || model.body.particles.empty()) return places;
    const Eigen::Vector3d centre = mean_place(body_places_in_tank(model.body, state));
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        const Eigen::Vector3d way = minimum_image(model, places[i].template cast<double>() - centre);
        for (const PeriodicAxis& axis : model.periodic)
            places[i][axis.axis] = static_cast<Real>(centre[axis.axis] + way[axis.axis]);
    }
    return places;
}

/// Those that frames of this model have of the fields: in scheme flex there are no forces of the water.
stream::Fields fields_of(const Model& model, stream::Fields fields) {
    fields.force &= model.scheme != Scheme::flex;
    return fields;
}

ordered_json fields_json(const stream::Fields& fields) {
    ordered_json names = ordered_json::array();
    if (fields.position) names.push_back("position");
    if (fields.velocity) names.push_back("velocity");
    if (fields.density) names.push_back("density");
    if (fields.force) names.push_back("force");
    return names;
}

ordered_json masses_json(const Model& model) {
    ordered_json masses = ordered_json::array();
    for (const double w : model.inverse_mass) masses.push_back(w > 0 ? ordered_json(1 / w) : ordered_json());
    return masses;
}

/// First fluid particle and their number; model_builder lays them out one after another.
ordered_json fluid_json(const Model& model) {
    int first = 0, count = 0;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i) && count++ == 0) first = i;
    return {first, count};
}

ordered_json clusters_json(const Model& model) {
    ordered_json clusters = ordered_json::array();
    for (const Cluster& cluster : model.clusters) clusters.push_back(cluster.particles);
    return clusters;
}

/// Those of a swimmer.
ordered_json muscles_json(const Creature& creature, const Model& model, int swimmer) {
    ordered_json muscles = ordered_json::array();
    const std::vector<Actuator> actuators = creature.actuator_list();
    for (const Muscle& muscle : model.muscles) {
        const int actuator = muscle.actuator - model.first_actuator_of(swimmer);
        if (actuator < 0 || actuator >= model.actuators_of(swimmer)) continue;
        const Spring& spring = model.springs[muscle.spring];
        muscles.push_back({{"a", spring.a},
                           {"b", spring.b},
                           {"actuator", actuator},
                           {"lateral", muscle.lateral},
                           {"restLength", spring.rest_length}});
        const Bend bend = actuators[static_cast<std::size_t>(actuator)].bend;
        if (bend != Bend::sideways) muscles.back()["bend"] = bend == Bend::vertical ? "vertical" : "contract";
    }
    return muscles;
}

/// Swimmers that are in the tank besides the first.
template <class Real>
ordered_json companions_json(const Simulation<Real>& simulation) {
    const Model& model = simulation.model();
    ordered_json companions = ordered_json::array();
    for (int k = 1; k < model.swimmers(); ++k) {
        const Body& body = model.body_of(k);
        const Creature& creature = simulation.scene().companions[static_cast<std::size_t>(k - 1)].creature;
        companions.push_back({{"name", creature.name},
                              {"body", body.particles},
                              {"slices", body.slices},
                              {"bodyLength", body.length},
                              {"joints", creature.joints},
                              {"actuators", model.actuators_of(k)},
                              {"muscles", muscles_json(creature, model, k)},
                              {"gait", gait_json(simulation.gait(k))}});
    }
    return companions;
}

/// [x, y, z] each.
template <class Vectors>
ordered_json triples_json(const Vectors& vectors) {
    ordered_json triples = ordered_json::array();
    for (const auto& v : vectors) triples.push_back({v[0], v[1], v[2]});
    return triples;
}

/// The mesh that goes with the body; null without one.
ordered_json skin_json(const Scene& scene, const Model& model) {
    if (!scene.creature || !scene.creature->skin) return nullptr;
    const Skin& skin = *scene.creature->skin;
    const std::vector<SkinWeight> weights = skin_weights(*scene.creature, model);
    ordered_json clusters = ordered_json::array(), others = clusters, shares = clusters;
    for (const SkinWeight& weight : weights) {
        clusters.push_back(weight.cluster);
        others.push_back(weight.other);
        shares.push_back(weight.share);
    }
    std::vector<Eigen::Vector3d> rest;
    for (const int particle : model.body.particles)
        rest.push_back(model.position[particle] - scene.creature->rear_centre);
    ordered_json body{{"file", skin.file},
                      {"digest", skin.digest},
                      {"unit", skin.unit},
                      {"axes", triples_json(skin.axes.rowwise())},
                      {"origin", {skin.origin.x(), skin.origin.y(), skin.origin.z()}},
                      {"vertices", triples_json(skin.vertices)},
                      {"triangles", triples_json(skin.triangles)},
                      {"cluster", clusters},
                      {"share", shares},
                      {"rest", triples_json(rest)}};
    if (scene.creature->regions) body["other"] = others;
    return body;
}

template <class Real>
constexpr Precision precision_of =
    sizeof(Real) == sizeof(double) ? Precision::double_precision : Precision::single_precision;

}  // namespace

std::string stream_message(std::string_view letters, const ordered_json& body) {
    MessageWriter message(letters);
    message.add_text(body.dump(-1, ' ', false, json::error_handler_t::replace));
    return message.finish();
}

template <class Real>
ordered_json stream_scene(const Simulation<Real>& simulation, const stream::SceneHead& head) {
    const SimulationSetup& setup = simulation.setup();
    const Scene& scene = simulation.scene();
    const Model& model = simulation.model();
    const SolverParameters& solver = model.parameters;
    const json overrides = setup.overrides.empty() ? json::object() : parse_json(setup.overrides, "overrides");
    ordered_json body;
    body["protocol"] = 2;
    body["program"] = {{"version", NATATOR_VERSION}, {"instructionSet", to_string(instruction_set())}};
    body["number"] = head.number;
    body["restarted"] = head.restarted;
    body["scene"] = setup.scene;
    body["overrides"] = overrides;
    if (setup.start) body["start"] = *setup.start;
    body["gait"] = gait_json(simulation.gait());
    body["scheme"] = to_string(model.scheme);
    body["precision"] = to_string(precision_of<Real>);
    body["definition"] = scene_definition(setup.scene, overrides, setup.data);
    body["timeStep"] = model.time_step;
    body["duration"] = scene.duration;
    body["radius"] = solver.radius;
    body["solidRestDistance"] = solver.solid_rest_distance;
    body["fluidRestDistance"] = solver.fluid_rest_distance;
    body["planes"] = planes_json(model);
    body["periodic"] = periodic_json(model);
    body["fields"] = fields_json(fields_of(model, head.fields));
    body["particles"] = model.particles();
    body["mass"] = masses_json(model);
    body["fluid"] = fluid_json(model);
    body["body"] = model.body.particles;
    body["slices"] = model.body.slices;
    body["bodyLength"] = model.body.length;
    body["companions"] = companions_json(simulation);
    body["clusters"] = clusters_json(model);
    body["joints"] = scene.creature ? scene.creature->joints : std::vector<int>{};
    body["actuators"] = model.actuators;
    body["muscles"] = scene.creature ? muscles_json(*scene.creature, model, 0) : ordered_json::array();
    body["skin"] = skin_json(scene, model);
    return body;
}

ordered_json stream_scene_change(const ordered_json& before, const ordered_json& now) {
    ordered_json body;
    for (const auto& [key, value] : now.items())
        if (key == "number" || key == "restarted" || !before.contains(key) || before.at(key) != value)
            body[key] = value;
    for (const auto& [key, value] : before.items())
        if (!now.contains(key)) body[key] = nullptr;
    return body;
}

template <class Real>
std::string stream_frame(Simulation<Real>& simulation, const stream::FrameHead& head) {
    const Model& model = simulation.model();
    const State<Real>& state = simulation.state();
    const std::vector<Real> densities = simulation.densities();
    const ConservationErrors errors = conservation_errors(model, state, densities);
    const Eigen::Vector3d velocity = centre_velocity(model, state, model.body.particles);
    const std::uint32_t running = head.running ? flag_running : 0;
    const std::uint32_t touches = touches_plane(model, state) ? flag_touches_plane : 0;

    MessageWriter message("FRAM");
    message.reserve(128 + 4 * model.actuators + std::size_t{40} * model.particles());
    message.add(head.scene);
    message.add(static_cast<std::uint32_t>(simulation.frames()));
    message.add(head.dropped);
    message.add(running | touches);
    message.add(state.time);
    message.add(head.wall_seconds);
    message.add(simulation.distance());
    message.add_numbers(velocity);
    message.add_numbers(std::initializer_list<double>{errors.linear_momentum, errors.angular_momentum,
                                                      errors.density_error_mean, errors.density_error_max});
    message.add(std::uint32_t{0});
    message.add_numbers(simulation.driven());
    if (head.fields.position) message.add_vectors(places_around_body(model, state));
    if (head.fields.velocity) message.add_vectors(state.velocity);
    if (head.fields.density) message.add_numbers(densities);
    if (fields_of(model, head.fields).force) message.add_vectors(simulation.forces());
    return message.finish();
}

template <class Real>
std::string stream_water(const Simulation<Real>& simulation, std::uint32_t scene, bool pressure) {
    if (pressure && simulation.model().scheme == Scheme::flex)
        throw InputError("pressure: scheme flex has none; must be conserving or lattice");
    const WaterField field = simulation.water();
    MessageWriter message("WATR");
    message.reserve(64 + 20 * field.velocity.size());
    message.add(scene);
    message.add(static_cast<std::uint32_t>(simulation.frames()));
    for (const int count : field.cells) message.add(static_cast<std::uint32_t>(count));
    message.add(static_cast<std::uint32_t>(pressure));
    message.add(simulation.state().time);
    message.add(field.cell);
    for (const double component : field.corner) message.add(component);
    message.add_vectors(field.velocity);
    message.add_numbers(field.density);
    if (pressure) message.add_numbers(field.pressure);
    return message.finish();
}

std::string stream_state(std::string_view saved) {
    MessageWriter message("STAT");
    message.reserve(saved.size() + 16);
    message.add_text(saved);
    return message.finish();
}

ordered_json stream_stop() {
    return {{"reason", "until"}};
}

ordered_json stream_stop(const Instability& instability) {
    return {{"reason", "unstable"},
            {"particle", instability.particle},
            {"stage", instability.stage},
            {"time", instability.time},
            {"law", instability.law}};
}

template ordered_json stream_scene(const Simulation<float>&, const stream::SceneHead&);
template ordered_json stream_scene(const Simulation<double>&, const stream::SceneHead&);
template std::string stream_water(const Simulation<float>&, std::uint32_t, bool);
template std::string stream_water(const Simulation<double>&, std::uint32_t, bool);
template std::string stream_frame(Simulation<float>&, const stream::FrameHead&);
template std::string stream_frame(Simulation<double>&, const stream::FrameHead&);

}  // namespace natator
