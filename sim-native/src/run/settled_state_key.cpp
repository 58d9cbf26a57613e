#include "settled_state_key.h"

#include <link.h>

#include <algorithm>
#include <cstdint>

#include "byte_writer.h"
#include "natator/instruction_set.h"

namespace natator {
namespace {

/// The build id that the linker put into the program or shared library that holds this function (ELF note
/// NT_GNU_BUILD_ID): a digest of all its code. Empty without one.
std::string build_id() {
    std::string id;
    const auto look = [](dl_phdr_info* info, std::size_t, void* found) {
        const auto here = reinterpret_cast<std::uintptr_t>(&build_id);
        const auto holds = [&](const ElfW(Phdr)& part) {
            return part.p_type == PT_LOAD && here - (info->dlpi_addr + part.p_vaddr) < part.p_memsz;
        };
        if (std::none_of(info->dlpi_phdr, info->dlpi_phdr + info->dlpi_phnum, holds)) return 0;
        for (int i = 0; i < info->dlpi_phnum; ++i) {
            if (info->dlpi_phdr[i].p_type != PT_NOTE) continue;
            // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader tells addresses as numbers
            const char* at = reinterpret_cast<const char*>(info->dlpi_addr + info->dlpi_phdr[i].p_vaddr);
            const char* const end = at + info->dlpi_phdr[i].p_memsz;
            const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
            while (at + sizeof(ElfW(Nhdr)) <= end) {
                const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at);
                const char* const name = at + sizeof *note;
                const char* const content = name + padded(note->n_namesz);
                if (note->n_type == NT_GNU_BUILD_ID && std::string(name, note->n_namesz) == std::string("GNU\0", 4))
                    static_cast<std::string*>(found)->assign(content, note->n_descsz);
                at = content + padded(note->n_descsz);
            }
        }
        return 1;
    };
    dl_iterate_phdr(look, &id);
    return id;
}

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
    static const std::string id = build_id();
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
