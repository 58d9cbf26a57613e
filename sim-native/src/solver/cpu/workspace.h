#pragma once

#include <cstdint>
#include <vector>

#include "aligned.h"
#include "cell_grid.h"
#include "natator/model.h"

namespace natator::cpu {

inline constexpr int lanes = 16;  ///< particles that a kernel works on side by side, one block

inline constexpr int round_up_to_block(int n) {
    return (n + lanes - 1) / lanes * lanes;
}

/// Arrays of one running State in slot order. Slots are numbered anew in every substep: first the fluid particles in
/// the order of their cells (within a cell by particle index, so that the order depends on positions alone), filled
/// up to whole blocks, then the solid particles likewise, then one far slot that unused list entries point to.
template <class Real>
struct Workspace {
    explicit Workspace(const Model& model);

    int particles = 0;
    int fluid = 0;                                      ///< fluid particles are in slots [0, fluid)
    int solid_begin = 0;                                ///< solid particles are in slots [solid_begin, slots)
    int slots = 0;                                      ///< the far slot is slots itself
    int blocks() const { return solid_begin / lanes; }  ///< of fluid
    int all_blocks() const { return round_up_to_block(slots + 1) / lanes; }

    std::vector<int> fluid_ids, solid_ids;  ///< particle indices by kind, ascending
    std::vector<int> slot_of;               ///< particle -> slot
    std::vector<int> particle_of;           ///< slot -> particle, -1 where a slot is unused

    // By particle.
    std::vector<Vector3<Real>> unsorted_position, unsorted_velocity;  ///< as they are predicted

    // By slot.
    Vector3Array<Real> position;            ///< as the iterations move it
    Vector3Array<Real> start;               ///< at the start of the substep
    Vector3Array<Real> predicted_velocity;  ///< velocity v* after external forces
    Vector3Array<Real> correction;          ///< sum of the constraints' corrections
    Vector3Array<Real> velocity;            ///< (x - x_start) / h, input of the viscosity; then the outcome
    AlignedVector<Real> constraint_count;   ///< n of the relaxation
    AlignedVector<Real> inverse_mass;
    AlignedVector<Real> solid_density;  ///< what solids add to the fluid's density
    AlignedVector<Real> density;        ///< in units of rest density
    AlignedVector<Real> compression;    ///< C = max(density - 1, 0)

    // Cells.
    CellGrid<Real> grid;
    std::vector<int> cell_of;                             ///< particle -> cell
    std::vector<int> fluid_cell_begin, solid_cell_begin;  ///< cell -> first slot; one more entry than cells

    // Fluid neighbours in sliced ELLPACK: block b holds rows [row_begin[b], row_begin[b+1]) of 16 slots each.
    std::vector<int> row_begin;
    AlignedVector<std::int32_t> neighbour;  ///< longer than the rows need
    std::vector<int> neighbour_count;       ///< by slot

    // Room for the fluid kernels, see FluidView.
    AlignedVector<Real> packed, packed_velocity, distance;

    // Contacts, pairs that are not both fluid: neighbours of contact_slots[k] are contact[contact_begin[k] .. [k+1]).
    std::vector<int> contact_slots;
    std::vector<int> contact_begin;
    std::vector<int> contact;

    /// Particles near a plane: bit k of `chosen` stands for slot 16 block + k.
    struct PlaneGroup {
        int plane;
        int block;
        unsigned chosen;
    };
    std::vector<PlaneGroup> plane_groups;  ///< last plane first, then by block
};

}  // namespace natator::cpu
