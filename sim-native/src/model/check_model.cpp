#include "check_model.h"

#include <cmath>
#include <string>

#include "base/check_values.h"
#include "base/text.h"
#include "natator/error.h"
#include "natator/limits.h"

namespace natator {
namespace {

std::string item(const std::string& list, std::size_t index) {
    return list + "[" + std::to_string(index) + "]";
}

void require_length(const std::string& name, std::size_t length, std::size_t wanted) {
    if (length != wanted)
        throw InputError("model: " + name + " has length " + std::to_string(length) + ": must have length " +
                         std::to_string(wanted));
}

/// `count`: of the things of which `index` is one. `name` gives the name of the index.
template <class Name>
void require_one_of(int index, std::size_t count, const Name& name) {
    if (index >= 0 && static_cast<std::size_t>(index) < count) return;
    throw InputError("model: " + name() + " = " + std::to_string(index) + ": must be one of " + std::to_string(count) +
                     ", numbered from 0");
}

void require_of_state(std::size_t found, const char* what, std::size_t wanted, const char* of_model = "") {
    if (found != wanted)
        throw InputError("state of " + std::to_string(found) + ' ' + what + ": must have " + std::to_string(wanted) +
                         " as its model" + of_model);
}

/// What sums over a kernel, or over the particles within the radius, would else not come to an end.
void check_kernels(const SolverParameters& parameters) {
    check_range("model: parameters.kernelSupport", parameters.conserving.kernel_support, limits::min_kernel_support,
                limits::max_kernel_support, false, " (rest distances of the fluid)");
    const double spacing = parameters.fluid_rest_distance;
    if (spacing > 0 && !(parameters.radius <= limits::radius_ratio * spacing))
        throw InputError("model: parameters.fluidRestDistance = " + number_text(spacing) +
                         ": must be at least radius / " + std::to_string(limits::radius_ratio) +
                         ", radius = " + number_text(parameters.radius));
}

void check_body(const Body& body, std::size_t particles, const std::string& name) {
    for (std::size_t i = 0; i < body.particles.size(); ++i)
        require_one_of(body.particles[i], particles, [&] { return item(name + ".particles", i); });
    for (std::size_t k = 0; k < body.slices.size(); ++k)
        for (std::size_t i = 0; i < body.slices[k].size(); ++i)
            require_one_of(body.slices[k][i], particles, [&] { return item(item(name + ".slices", k), i); });
}

}  // namespace

void check_model(const Model& model) {
    check_kernels(model.parameters);
    const std::size_t particles = model.position.size();
    require_length("velocity", model.velocity.size(), particles);
    require_length("inverse_mass", model.inverse_mass.size(), particles);
    require_length("phase", model.phase.size(), particles);
    if (!model.rest_position.empty()) require_length("rest_position", model.rest_position.size(), particles);
    for (std::size_t s = 0; s < model.springs.size(); ++s) {
        require_one_of(model.springs[s].a, particles, [s] { return item("springs", s) + ".a"; });
        require_one_of(model.springs[s].b, particles, [s] { return item("springs", s) + ".b"; });
    }
    for (std::size_t c = 0; c < model.clusters.size(); ++c) {
        const Cluster& cluster = model.clusters[c];
        require_length(item("clusters", c) + ".rest_offset", cluster.rest_offset.size(), cluster.particles.size());
        for (std::size_t i = 0; i < cluster.particles.size(); ++i)
            require_one_of(cluster.particles[i], particles,
                           [c, i] { return item("clusters", c) + item(".particles", i); });
    }
    if (model.actuators < 0)
        throw InputError("model: actuators = " + std::to_string(model.actuators) + ": must be at least 0");
    if (model.companions.size() > limits::companions)
        throw InputError("model: companions has length " + std::to_string(model.companions.size()) +
                         ": must have length " + std::to_string(limits::companions) + " at most");
    std::size_t actuators = static_cast<std::size_t>(model.actuators);
    for (std::size_t k = 0; k < model.companions.size(); ++k) {
        const Gait& gait = model.companions[k].gait;
        require_length(item("companions", k) + ".gait.phase", gait.phase.size(), gait.amplitude.size());
        if (!gait.offset.empty())
            require_length(item("companions", k) + ".gait.offset", gait.offset.size(), gait.amplitude.size());
        if (static_cast<std::size_t>(model.companions[k].first_actuator) != actuators)
            throw InputError("model: " + item("companions", k) +
                             ".first_actuator = " + std::to_string(model.companions[k].first_actuator) + ": must be " +
                             std::to_string(actuators) + ", the number of actuators before");
        actuators += gait.amplitude.size();
        const int low = model.first_spring_of(static_cast<int>(k)), first = model.companions[k].first_spring;
        if (first < low || static_cast<std::size_t>(first) > model.springs.size())
            throw InputError("model: " + item("companions", k) + ".first_spring = " + std::to_string(first) +
                             ": must be in [" + std::to_string(low) + ", " + std::to_string(model.springs.size()) +
                             ']');
    }
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
        require_one_of(model.muscles[m].spring, model.springs.size(), [m] { return item("muscles", m) + ".spring"; });
        require_one_of(model.muscles[m].actuator, actuators, [m] { return item("muscles", m) + ".actuator"; });
    }
    for (std::size_t k = 0; k < model.periodic.size(); ++k)
        require_one_of(model.periodic[k].axis, 3, [k] { return item("periodic", k) + ".axis"; });
    check_body(model.body, particles, "body");
    for (std::size_t k = 0; k < model.companions.size(); ++k)
        check_body(model.companions[k].body, particles, item("companions", k) + ".body");
}

void check_driven(const Model& model, const std::vector<double>& driven) {
    if (driven.size() == static_cast<std::size_t>(model.first_actuator_of(model.swimmers()))) return;
    check_length("drive", driven.size(), model.actuators);
}

void check_step(double time_step, int substeps) {
    if (!(time_step > 0) || std::isinf(time_step))
        throw InputError("time step = " + number_text(time_step) + ": must be a finite number above 0 (s)");
    if (substeps < 1) throw InputError("substeps = " + std::to_string(substeps) + ": must be at least 1");
}

void check_threads(int threads) {
    if (threads > limits::threads)
        throw InputError("threads = " + std::to_string(threads) + ": must be at most " +
                         std::to_string(limits::threads));
}

void check_particles(const Model& model, const std::vector<int>& particles) {
    for (std::size_t i = 0; i < particles.size(); ++i)
        require_one_of(particles[i], model.position.size(), [&] { return item("particles", i); });
}

template <class Real>
void check_places(const Model& model, const State<Real>& state) {
    require_of_state(state.position.size(), "particles", model.position.size());
}

template <class Real>
void check_springs(const Model& model, const State<Real>& state) {
    require_of_state(state.spring_rest_length.size(), "springs", model.springs.size());
}

template <class Real>
void check_places_and_velocities(const Model& model, const State<Real>& state) {
    check_places(model, state);
    require_of_state(state.velocity.size(), "velocities", model.position.size(), " has particles");
}

template <class Real>
void check_state(const Model& model, const State<Real>& state) {
    if (state.position.size() != model.position.size() || state.velocity.size() != model.position.size() ||
        state.cluster_rotation.size() != model.clusters.size() ||
        state.cluster_centre.size() != model.clusters.size() || state.spring_rest_length.size() != model.springs.size())
        throw InputError("state of " + std::to_string(state.position.size()) + " particles, " +
                         std::to_string(state.cluster_rotation.size()) + " clusters, " +
                         std::to_string(state.spring_rest_length.size()) + " springs: must have " +
                         std::to_string(model.particles()) + ", " + std::to_string(model.clusters.size()) + ", " +
                         std::to_string(model.springs.size()) + " as its model");
}

template void check_places(const Model&, const State<float>&);
template void check_places(const Model&, const State<double>&);
template void check_springs(const Model&, const State<float>&);
template void check_springs(const Model&, const State<double>&);
template void check_places_and_velocities(const Model&, const State<float>&);
template void check_places_and_velocities(const Model&, const State<double>&);
template void check_state(const Model&, const State<float>&);
template void check_state(const Model&, const State<double>&);

}  // namespace natator
