#include "particle_experiment.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "base/field.h"
#include "base/text.h"
#include "model/cluster.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "natator/scene.h"

namespace natator {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& where, const std::string& field, const json& value,
                         const std::string& allowed) {
    throw InputError(where + ": " + field + " = " + shown(value) + ": must be " + allowed);
}

/// What an object that is an experiment, or the part of it that `path` begins with ("springs.idx"), has there; it must
/// have it.
const json& member(const json& object, const std::string& path, const std::string& where, const char* allowed) {
    const std::size_t dot = path.find('.');
    const std::string key = dot == std::string::npos ? path : path.substr(dot + 1);
    if (!object.contains(key)) throw InputError(where + ": " + path + ": missing; must be given, " + allowed);
    return object.at(key);
}

double number(const json& value, const std::string& where, const std::string& field) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(where, field, value, "a finite number");
    return value.get<double>();
}

int integer(const json& value, const std::string& where, const std::string& field, long lowest, long highest) {
    if (!value.is_number_integer() || value.get<long>() < lowest || value.get<long>() > highest)
        refuse(where, field, value, "an integer from " + std::to_string(lowest) + " to " + std::to_string(highest));
    return value.get<int>();
}

/// An array of `count` rows (any number if negative), each read by `read(row, field)`.
template <class T>
std::vector<T> rows(const json& value, const std::string& where, const std::string& field, long count,
                    const std::function<T(const json&, const std::string&)>& read) {
    if (!value.is_array()) refuse(where, field, value, "an array");
    if (count >= 0 && value.size() != static_cast<std::size_t>(count))
        throw InputError(where + ": " + field + " has length " + std::to_string(value.size()) + ": must have length " +
                         std::to_string(count));
    std::vector<T> result;
    for (std::size_t i = 0; i < value.size(); ++i)
        result.push_back(read(value[i], field + "[" + std::to_string(i) + "]"));
    return result;
}

/// Reads the arrays of one experiment with its name in every message.
struct Reader {
    const std::string& where;

    Eigen::VectorXd vector(const json& value, const std::string& field, int size) const {
        if (!value.is_array() || value.size() != static_cast<std::size_t>(size))
            refuse(where, field, value, "an array of " + std::to_string(size) + " numbers");
        Eigen::VectorXd result(size);
        for (int k = 0; k < size; ++k) result[k] = number(value[k], where, field + "[" + std::to_string(k) + "]");
        return result;
    }
    std::vector<Eigen::Vector3d> points(const json& value, const std::string& field, long count) const {
        return rows<Eigen::Vector3d>(
            value, where, field, count,
            [&](const json& row, const std::string& name) -> Eigen::Vector3d { return vector(row, name, 3); });
    }
    std::vector<double> numbers(const json& value, const std::string& field, long count) const {
        return rows<double>(value, where, field, count,
                            [&](const json& row, const std::string& name) { return number(row, where, name); });
    }
    std::vector<int> indices(const json& value, const std::string& field, long count, long highest) const {
        return rows<int>(value, where, field, count, [&](const json& row, const std::string& name) {
            return integer(row, where, name, 0, highest);
        });
    }
};

/// Parameters as NVIDIA Flex has them after its creation (its documentation and tests/conformance/README.md): all 0
/// but these.
SolverParameters flex_defaults() {
    SolverParameters p = thesis_tank().solver;
    p.iterations = 1;
    p.gravity.setZero();
    for (double* value : {&p.radius, &p.solid_rest_distance, &p.fluid_rest_distance, &p.dynamic_friction,
                          &p.static_friction, &p.particle_friction, &p.damping, &p.flex.viscosity,
                          &p.flex.solidPressure, &p.buoyancy, &p.collision_distance})
        *value = 0;
    p.max_acceleration = p.max_speed;
    return p;
}

std::vector<Plane> read_planes(const json& value, const Reader& read) {
    return rows<Plane>(value, read.where, "params.planes", -1, [&](const json& row, const std::string& field) {
        const Eigen::VectorXd plane = read.vector(row, field, 4);
        if (std::abs(plane.head<3>().norm() - 1) > 1e-3)
            refuse(read.where, field, row, "a normal (first three) of length 1");
        return Plane{plane.head<3>(), plane[3]};
    });
}

void read_parameters(const json& params, const Reader& read, Model& model) {
    SolverParameters& p = model.parameters;
    model.scheme = Scheme::flex;
    p = flex_defaults();
    const std::map<std::string, double*> scalars{{"radius", &p.radius},
                                                 {"solidRestDistance", &p.solid_rest_distance},
                                                 {"fluidRestDistance", &p.fluid_rest_distance},
                                                 {"dynamicFriction", &p.dynamic_friction},
                                                 {"staticFriction", &p.static_friction},
                                                 {"particleFriction", &p.particle_friction},
                                                 {"restitution", &p.restitution},
                                                 {"adhesion", &p.adhesion},
                                                 {"sleepThreshold", &p.sleep_threshold},
                                                 {"maxSpeed", &p.max_speed},
                                                 {"maxAcceleration", &p.max_acceleration},
                                                 {"shockPropagation", &p.shock_propagation},
                                                 {"dissipation", &p.dissipation},
                                                 {"damping", &p.damping},
                                                 {"cohesion", &p.cohesion},
                                                 {"surfaceTension", &p.surface_tension},
                                                 {"viscosity", &p.flex.viscosity},
                                                 {"vorticityConfinement", &p.vorticity_confinement},
                                                 {"solidPressure", &p.flex.solidPressure},
                                                 {"freeSurfaceDrag", &p.free_surface_drag},
                                                 {"buoyancy", &p.buoyancy},
                                                 {"collisionDistance", &p.collision_distance},
                                                 {"particleCollisionMargin", &p.particle_collision_margin},
                                                 {"shapeCollisionMargin", &p.shape_collision_margin},
                                                 {"relaxationFactor", &p.relaxation_factor}};
    if (!params.is_object()) refuse(read.where, "params", params, "an object");
    for (const auto& [key, value] : params.items()) {
        const std::string field = "params." + key;
        if (const auto scalar = scalars.find(key); scalar != scalars.end())
            *scalar->second = number(value, read.where, field);
        else if (key == "gravity")
            p.gravity = read.vector(value, field, 3);
        else if (key == "planes")
            model.planes = read_planes(value, read);
        else if (key == "numIterations")
            p.iterations = integer(value, read.where, field, 1, 10000);
        else if (key == "solidIterations")
            p.conserving.solid_iterations = integer(value, read.where, field, 1, 10000);
        else if (key == "relaxationMode")
            p.flex.relaxationMode = static_cast<RelaxationMode>(integer(value, read.where, field, 0, 1));
        else
            throw InputError(read.where + ": " + field + ": unknown key (= " + shown(value) + ")");
    }
    if (!(p.radius > 0)) refuse(read.where, "params.radius", p.radius, "a length above 0");
    if (p.fluid_rest_distance > 0 && p.radius > limits::radius_ratio * p.fluid_rest_distance)
        refuse(read.where, "params.fluidRestDistance", p.fluid_rest_distance,
               "0 or at least radius / " + std::to_string(limits::radius_ratio));
}

void read_springs(const json& springs, const Reader& read, Model& model) {
    fields::check_keys(springs, {read.where, "springs"}, {"idx", "l0", "k"});
    const auto pairs = rows<std::vector<int>>(
        member(springs, "springs.idx", read.where, "pairs of particles"), read.where, "springs.idx", -1,
        [&](const json& row, const std::string& field) { return read.indices(row, field, 2, model.particles() - 1); });
    const long count = static_cast<long>(pairs.size());
    const auto lengths = read.numbers(member(springs, "springs.l0", read.where, "rest lengths"), "springs.l0", count);
    const auto stiffnesses = read.numbers(member(springs, "springs.k", read.where, "stiffnesses"), "springs.k", count);
    for (long s = 0; s < count; ++s) model.springs.push_back({pairs[s][0], pairs[s][1], lengths[s], stiffnesses[s]});
}

void read_clusters(const json& rigids, const Reader& read, Model& model) {
    fields::check_keys(rigids, {read.where, "rigids"}, {"clusters", "rest", "stiff", "rot", "trans"});
    const auto members = rows<std::vector<int>>(
        member(rigids, "rigids.clusters", read.where, "lists of particles"), read.where, "rigids.clusters", -1,
        [&](const json& row, const std::string& field) { return read.indices(row, field, -1, model.particles() - 1); });
    const long count = static_cast<long>(members.size());
    const auto rest = read.points(member(rigids, "rigids.rest", read.where, "a rest position per particle"),
                                  "rigids.rest", model.particles());
    const json& given = member(rigids, "rigids.stiff", read.where, "a stiffness per cluster");
    auto stiffness = read.numbers(given, "rigids.stiff", given.is_array() && given.size() == 1 ? 1 : count);
    stiffness.resize(members.size(), stiffness.empty() ? 0 : stiffness.front());
    for (long c = 0; c < count; ++c) {
        if (members[c].empty())
            refuse(read.where, "rigids.clusters[" + std::to_string(c) + "]", json::array(), "at least one particle");
        model.clusters.push_back(make_cluster(members[c], rest, stiffness[c]));
    }
    if (rigids.contains("rot")) {
        const auto rotations = rows<Eigen::VectorXd>(
            rigids["rot"], read.where, "rigids.rot", count,
            [&](const json& row, const std::string& field) { return read.vector(row, field, 4); });
        for (long c = 0; c < count; ++c) model.clusters[c].rotation.coeffs() = rotations[c];
    }
    if (rigids.contains("trans")) {
        const auto centres = read.points(rigids["trans"], "rigids.trans", count);
        for (long c = 0; c < count; ++c) model.clusters[c].centre = centres[c];
    }
}

}  // namespace

ParticleExperiment read_particle_experiment(const json& source, const std::string& where) {
    const Reader read{where};
    fields::check_keys(
        source, {where, ""},
        {"name", "dt", "substeps", "params", "pos", "vel", "invm", "phase", "springs", "rigids", "rest", "frames"});
    ParticleExperiment experiment;
    Model& model = experiment.model;
    if (source.contains("name") && source["name"].is_string()) experiment.name = source["name"];
    experiment.time_step = number(member(source, "dt", where, "the time step in s"), where, "dt");
    if (!(experiment.time_step > 0)) refuse(where, "dt", source["dt"], "a time above 0");
    experiment.substeps =
        integer(member(source, "substeps", where, "a number of substeps"), where, "substeps", 1, 1000000);
    model.time_step = experiment.time_step;
    model.parameters.substeps = experiment.substeps;

    model.position = read.points(member(source, "pos", where, "positions"), "pos", -1);
    const long count = model.particles();
    model.velocity = read.points(member(source, "vel", where, "velocities"), "vel", count);
    model.inverse_mass = read.numbers(member(source, "invm", where, "inverse masses"), "invm", count);
    for (long i = 0; i < count; ++i)
        if (model.inverse_mass[i] < 0)
            refuse(where, "invm[" + std::to_string(i) + "]", model.inverse_mass[i], "an inverse mass of 0 or more");
    for (const int bits :
         read.indices(member(source, "phase", where, "phases"), "phase", count, std::numeric_limits<int>::max()))
        model.phase.push_back(static_cast<std::uint32_t>(bits));
    if (source.contains("rest")) model.rest_position = read.points(source["rest"], "rest", count);

    read_parameters(member(source, "params", where, "the solver's parameters"), read, model);
    model.parameters.substeps = experiment.substeps;
    if (source.contains("springs")) read_springs(source["springs"], read, model);
    if (source.contains("rigids")) read_clusters(source["rigids"], read, model);
    return experiment;
}

}  // namespace natator
