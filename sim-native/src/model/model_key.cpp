#include "model_key.h"

#include "base/byte_writer.h"

namespace natator {
namespace {

template <class... Values>
void add(ByteWriter& key, const Values&... values) {
    (key.add(values), ...);
}

// Structures are taken apart into all of their members: what has one more or less does not compile before it is listed
// here.

void add_parameters(ByteWriter& key, const SolverParameters& parameters) {
    const auto& [substeps, iterations, flex, conserving, gravity, radius, solid_rest_distance, fluid_rest_distance,
                 dynamic_friction, static_friction, particle_friction, restitution, adhesion, sleep_threshold,
                 max_speed, max_acceleration, shock_propagation, dissipation, damping, cohesion, surface_tension,
                 vorticity_confinement, free_surface_drag, buoyancy, collision_distance, particle_collision_margin,
                 shape_collision_margin, relaxation_factor] = parameters;
    add(key, substeps, iterations, gravity, radius, solid_rest_distance, fluid_rest_distance, dynamic_friction,
        static_friction, particle_friction, restitution, adhesion, sleep_threshold, max_speed, max_acceleration,
        shock_propagation, dissipation, damping, cohesion, surface_tension, vorticity_confinement, free_surface_drag,
        buoyancy, collision_distance, particle_collision_margin, shape_collision_margin, relaxation_factor);
    const auto& [viscosity, solid_pressure, relaxation_mode, max_neighbours] = flex;
    add(key, viscosity, solid_pressure, relaxation_mode, max_neighbours);
    const auto& [solid_iterations, max_iterations, density_tolerance, kinematic_viscosity, kernel_support,
                 modified_pressure] = conserving;
    add(key, solid_iterations, max_iterations, density_tolerance, kinematic_viscosity, kernel_support,
        modified_pressure);
}

void add_water_box(ByteWriter& key, const WaterBox& box) {
    const auto& [cells, cell, corner, faces, viscosity, density, current, smagorinsky, obstacles] = box;
    add(key, cells, cell, corner, viscosity, density, current, smagorinsky);
    for (const auto& ends : faces) add(key, ends[0], ends[1]);
    for (const auto& [obstacle, particles] : obstacles) {
        const auto& [shape, centre, radius, size, points, spacing] = obstacle;
        add(key, shape, centre, radius, size, points, spacing, particles);
    }
}

/// What settling depends on.
void add_start(ByteWriter& key, const Model& model) {
    // Muscles rest while a model settles, and its own time step is that of later.
    const auto& [scheme, parameters, time_step, position, velocity, inverse_mass, phase, rest_position, planes,
                 water_box, periodic, springs, clusters, muscles, actuators, body, companions] = model;
    add(key, scheme, position, velocity, inverse_mass, phase, rest_position, body.spacing);
    add_parameters(key, parameters);
    for (const auto& [normal, offset] : planes) add(key, normal, offset);
    if (water_box) add_water_box(key, *water_box);
    for (const auto& [axis, low, high] : periodic) add(key, axis, low, high);
    for (const auto& [a, b, rest_length, stiffness] : springs) add(key, a, b, rest_length, stiffness);
    for (const auto& [particles, rest_offset, stiffness, rotation, centre] : clusters)
        add(key, particles, rest_offset, stiffness, rotation, centre);
}

void add_body(ByteWriter& key, const Body& whole) {
    const auto& [particles, slices, length, spacing] = whole;
    add(key, particles, slices, length, spacing);
}

}  // namespace

std::string start_key(const Model& model) {
    ByteWriter key;
    add_start(key, model);
    return key.take();
}

std::string model_key(const Model& model) {
    ByteWriter key;
    add_start(key, model);
    add(key, model.time_step, model.actuators);
    for (const auto& [spring, actuator, lateral] : model.muscles) add(key, spring, actuator, lateral);
    add_body(key, model.body);
    for (const auto& [body, gait, first_actuator, first_spring] : model.companions) {
        const auto& [frequency, amplitude, phase, power, offset] = gait;
        add_body(key, body);
        add(key, frequency, amplitude, phase, power, offset, first_actuator, first_spring);
    }
    return key.take();
}

}  // namespace natator
