#include "settled_state_key.h"

#include "base/system.h"
#include "byte_writer.h"
#include "natator/instruction_set.h"

namespace natator {
namespace {

void add_parameters(ByteWriter& key, const SolverParameters& p) {
    static_assert(sizeof(SolverParameters) == 280, "a parameter was added or removed: list it here");
    for (const int value : {p.substeps, p.iterations, p.conserving.solid_iterations, p.conserving.max_iterations, p.flex.maxNeighborsPerParticle}) key.add(value);
    key.add(p.gravity);
    for (const double value : {p.conserving.density_tolerance,
                               p.radius,
                               p.solid_rest_distance,
                               p.fluid_rest_distance,
                               p.dynamic_friction,
                               p.static_friction,
                               p.particle_friction,
                               p.restitution,
                               p.adhesion,
                               p.sleep_threshold,
                               p.max_speed,
                               p.max_acceleration,
                               p.shock_propagation,
                               p.dissipation,
                               p.damping,
                               p.cohesion,
                               p.surface_tension,
                               p.flex.viscosity,
                               p.conserving.kernel_support,
                               p.conserving.kinematic_viscosity,
                               p.vorticity_confinement,
                               p.flex.solidPressure,
                               p.free_surface_drag,
                               p.buoyancy,
                               p.collision_distance,
                               p.particle_collision_margin,
                               p.shape_collision_margin,
                               p.relaxation_factor})
        key.add(value);
    key.add(p.flex.relaxationMode);
    key.add(p.conserving.modified_pressure);
}

}  // namespace

std::string settled_state_key(const Model& model, const Settling& settling, int real_bytes) {
    static const std::string id = system::build_id();
    if (id.empty()) return {};
    ByteWriter key;
    key.add(id);
    key.add(instruction_set());
    key.add(real_bytes);
    key.add(settling.updates);
    key.add(settling.time_step);
    key.add(settling.substeps);
    key.add(model.scheme);
    add_parameters(key, model.parameters);
    for (const auto* vectors : {&model.position, &model.velocity, &model.rest_position}) key.add(*vectors);
    key.add(model.inverse_mass);
    key.add(model.phase);
    for (const Plane& plane : model.planes) {
        key.add(plane.normal);
        key.add(plane.offset);
    }
    for (const PeriodicAxis& periodic : model.periodic) {
        key.add(periodic.axis);
        key.add(periodic.low);
        key.add(periodic.high);
    }
    for (const Spring& spring : model.springs) {
        key.add(spring.a);
        key.add(spring.b);
        key.add(spring.rest_length);
        key.add(spring.stiffness);
    }
    for (const Cluster& cluster : model.clusters) {
        key.add(cluster.particles);
        key.add(cluster.rest_offset);
        key.add(cluster.stiffness);
        key.add(cluster.rotation);
        key.add(cluster.centre);
    }
    return key.bytes();
}

}  // namespace natator
