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

template <class... Values>
void add(ByteWriter& key, const Values&... values) {
    (key.add(values), ...);
}

// Structures are taken apart into all of their members: what has one more or less does not compile before it is listed here.

void add_parameters(ByteWriter& key, const SolverParameters& parameters) {
    const auto& [substeps, iterations, flex, conserving, gravity, radius, solid_rest_distance, fluid_rest_distance,
                 dynamic_friction, static_friction, particle_friction, restitution, adhesion, sleep_threshold, max_speed,
                 max_acceleration, shock_propagation, dissipation, damping, cohesion, surface_tension,
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
    const auto& [cells, cell, corner, faces, viscosity, density] = box;
    add(key, cells, cell, corner, viscosity, density);
    for (const auto& ends : faces) add(key, ends[0], ends[1]);
}

}  // namespace

std::string settled_state_key(const Model& model, const Settling& settling, int real_bytes) {
    static const std::string id = build_id();
    if (id.empty()) return {};
    ByteWriter key;
    add(key, id, instruction_set(), real_bytes);
    const auto& [updates, step, settling_substeps] = settling;
    add(key, updates, step, settling_substeps);

    // Muscles rest while a model settles, and its own time step is that of later.
    const auto& [scheme, parameters, time_step, position, velocity, inverse_mass, phase, rest_position, planes, water_box,
                 periodic, springs, clusters, muscles, actuators, body, companions] = model;
    add(key, scheme, position, velocity, inverse_mass, phase, rest_position, body.spacing);
    add_parameters(key, parameters);
    for (const auto& [normal, offset] : planes) add(key, normal, offset);
    if (water_box) add_water_box(key, *water_box);
    for (const auto& [axis, low, high] : periodic) add(key, axis, low, high);
    for (const auto& [a, b, rest_length, stiffness] : springs) add(key, a, b, rest_length, stiffness);
    for (const auto& [particles, rest_offset, stiffness, rotation, centre] : clusters)
        add(key, particles, rest_offset, stiffness, rotation, centre);
    return key.bytes();
}

}  // namespace natator
