#pragma once

#include <array>
#include <vector>

#include "ghosts.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "physics/background_pressure.h"
#include "solver/cpu/aligned.h"
#include "solver/cpu/cell_grid.h"
#include "solver/cpu/neighbour_lists.h"
#include "solver/cpu/thread_team.h"
#include "water_kernels.h"

namespace natator::cpu {

/// The water of scheme `conserving` and the bodies in it: what a substep's pressure and viscosity do to the velocities
/// of all particles. Solids take part like fluid that has their mass, volume and velocity: that is the coupling of body
/// and water, pressure and no-slip viscosity alike, with equal and opposite impulses.
template <class Real>
class Water {
public:
    explicit Water(const Model& model);

    // The stages of a substep, in this order.

    /// Takes the state at the start of a substep of length h (s).
    void find_neighbours(const State<Real>& state, Real h, ThreadTeam& team);
    /// Density and G_ij.
    void compute_gradients(ThreadTeam& team);
    /// Whether particles overlap. If so passes on velocities that begin at 0 follow, and end_overlap_separation.
    bool begin_overlap_separation(ThreadTeam& team);
    void separate_overlaps(ThreadTeam& team);
    /// Puts where they have led to into shift().
    void end_overlap_separation(ThreadTeam& team);
    /// Takes off part of what compresses.
    void solve_divergence(ThreadTeam& team);
    void add_viscosity(ThreadTeam& team);
    /// Cohesion, surface tension, vorticity confinement and free-surface drag.
    void add_forces(ThreadTeam& team);
    void add_gravity(ThreadTeam& team);
    /// One Jacobi pass: the impulses that push apart where the velocities compress more than target_ allows, which
    /// after add_gravity() is where they lead to more than rest density.
    void compute_impulses(ThreadTeam& team);
    /// How far the velocities were from target_ when compute_impulses ran, as a change of the fluid's density in the
    /// substep, in rest densities.
    Residual target_residual() const;
    /// How far the velocities are from target_ now, without applying impulses; in rest densities.
    Residual measure_target_residual(ThreadTeam& team);
    /// Applies the impulses to the velocities, less what physics::zeroth_order_correction takes off.
    void apply_corrected_impulses(ThreadTeam& team);
    /// Once all passes are done: gives back what these have taken off.
    void return_zeroth_order_correction(ThreadTeam& team);

    /// The velocity of a particle as the last stage left it, length/s.
    Vec3<Real> velocity(int particle) const { return velocity_.at(slot_of_[particle]); }
    /// Sets the velocity of a particle, length/s. Call update_ghost_velocities once all are set.
    void set_velocity(int particle, const Vec3<Real>& v) {
        const int slot = slot_of_[particle];
        velocity_.set(slot, v);
        packed_velocity_[4 * slot] = v.x;
        packed_velocity_[4 * slot + 1] = v.y;
        packed_velocity_[4 * slot + 2] = v.z;
    }
    /// Once all passes are done: holds up what lies at walls, see physics::hydrostatic_ghost_impulse.
    void apply_wall_pressure(ThreadTeam& team);
    /// Gives the ghosts the reflected velocities of their owners.
    void update_ghost_velocities(ThreadTeam& team);
    /// The displacement of a particle that keeps particles evenly spread and separates overlaps, length; no velocity
    /// comes with it.
    Vec3<Real> shift(int particle) const;

    /// The density of a particle at the last substep's start, in rest densities.
    Real density(int particle) const { return density_[slot_of_[particle]]; }
    /// The pressure of a particle in the last substep, mass/(length s^2).
    Real pressure(int particle) const {
        const int slot = slot_of_[particle];
        const Real solved = impulse_sum_[slot] / h_;
        return carried_.any() ? solved + carried_.pressure(position_.at(slot), fluid_density_) : solved;
    }
    int neighbours(int particle) const { return neighbour_count_[slot_of_[particle]]; }

    /// Begins to sum the water's impulses on solids.
    void keep_forces() { impulse_on_.assign(particles_, {}); }
    void clear_forces();
    /// Adds the impulses of pressure on solids. Call it after return_zeroth_order_correction.
    void add_pressure_forces();
    /// Mean forces on the particles over the substeps since clear_forces; see Solver::forces.
    std::vector<Vector3<Real>> forces() const;

private:
    using Ghost = typename Ghosts<Real>::Ghost;

    /// Positions of the particles as the water has them: in a periodic tank all within its ends.
    const std::vector<Vector3<Real>>& places_in_tank(const State<Real>& state);
    void lay_out(const State<Real>& state, ThreadTeam& team);
    void sort_into_cells(const std::vector<Vector3<Real>>& position, const std::vector<Ghost>& ghosts,
                         ThreadTeam& team);
    void make_room(std::size_t slots);
    void list_neighbours(ThreadTeam& team);
    void update_ghost_corrections(ThreadTeam& team);
    void apply_impulses(ThreadTeam& team);
    /// Gives the ghosts the reflected vectors of their owners, where neighbours gather them.
    void update_ghosts(AlignedVector<Real>& packed, ThreadTeam& team);
    WaterView<Real> view();

    void add_viscous_forces(Real strength, Real limit);
    template <class Visit>
    void for_each_solid_slot(const Visit& visit) const;

    void drag_free_surface(ThreadTeam& team);
    void add_cohesion(ThreadTeam& team);
    void add_surface_tension(ThreadTeam& team);
    void add_vorticity_confinement(ThreadTeam& team);
    /// Whether the particle of a slot, or the owner of a ghost's slot, is fluid.
    bool is_fluid_slot(int slot) const {
        return model_.is_fluid(particle_of_[slot < ghost_begin_ ? slot : ghost_owner_[slot - ghost_begin_]]);
    }
    /// The velocity of a slot as neighbours gather it, length/s.
    Vec3<Real> packed_velocity(int slot) const {
        const Real* const v = &packed_velocity_[4 * static_cast<std::size_t>(slot)];
        return {v[0], v[1], v[2]};
    }
    /// Not for particles of infinite mass.
    void push(int slot, const Vec3<Real>& velocity_change) {
        if (inverse_mass_[slot] > 0) velocity_.add(slot, velocity_change);
    }
    /// Calls visit(entry, other) for the entries of a slot's row.
    template <class Visit>
    void for_each_neighbour_of(int slot, const Visit& visit) const {
        for (int row = row_begin_[slot / lanes]; row < row_begin_[slot / lanes + 1]; ++row) {
            const int entry = row * lanes + slot % lanes, other = neighbour_[entry];
            if (other == far_slot_) return;  // the rest of the column is unused
            visit(entry, other);
        }
    }
    template <class Visit>
    void for_each_fluid_within_radius(int slot, const Visit& visit) const;
    template <class Work>
    void for_fluid_slots(ThreadTeam& team, const Work& work);

    /// Calls work(k) for each ghost, k being its slot - ghost_begin_.
    template <class Work>
    void for_each_ghost(ThreadTeam& team, const Work& work) {
        team.for_each(static_cast<int>(ghost_owner_.size()), min_run, work);
    }
    template <class Work>
    void for_each_slot(ThreadTeam& team, const Work& work) {
        team.for_each(particles_, min_run, work);
    }
    template <class Work>
    void on_all_threads(ThreadTeam& team, const Work& work) {
        const WaterView<Real> all = view();
        team.for_parts(all.end_block, min_part, [&](int, int begin, int end) {
            WaterView<Real> part = all;
            part.first_block = begin;
            part.end_block = end;
            work(part);
        });
    }
    static constexpr int min_part = 8;  ///< blocks
    /// particles or ghosts that little is done with; fewer are done before another thread is awake
    static constexpr int min_run = 2048;

    const Model& model_;
    const WaterKernels<Real>* kernels_;
    const NeighbourKernels<Real>* neighbour_kernels_;
    Real radius_, spacing_, kernel_scale_, at_spacing_, dynamic_viscosity_;
    Real fluid_density_;                                           ///< mass/length^3
    Real max_expansion_rate_;                                      ///< by the velocities, of what is compressed, 1/s
    Real effect_radius_;                                           ///< R of physics/water_effects.h
    std::vector<Real> volume_of_, inverse_mass_of_, mobility_of_;  ///< by particle
    Ghosts<Real> ghosts_;
    std::vector<physics::PeriodicAxis<Real>> periodic_axes_;
    std::vector<Vector3<Real>> in_tank_;  ///< by particle; empty where no axis is periodic
    CellGrid<Real> grid_;
    Vec3<Real> fluid_gravity_;    ///< of the fluid, length/s^2
    Vec3<Real> weight_on_walls_;  ///< its part along axes that have ends
    physics::CarriedWeight<Real> carried_;
    Real h_ = 1;

    int particles_, ghost_begin_, far_slot_ = 0;
    std::vector<int> slot_of_, particle_of_;
    std::vector<int> ghost_owner_, ghost_transform_;  ///< by ghost slot - ghost_begin_
    std::vector<int> ghost_slot_;                     ///< by ghost, as Ghosts has them
    std::vector<int> cell_begin_, ghost_cell_begin_;
    std::vector<int> cell_of_;  ///< by particle

    Vector3Array<Real> position_, velocity_, crowding_;
    Vector3Array<Real> kept_velocity_;    ///< room for the separation of overlaps
    Vector3Array<Real> field_;            ///< of add_forces, also of ghosts: normals, then vorticity
    std::vector<Real> strength_;          ///< of the vorticity, also of ghosts
    std::vector<Vec3<Real>> separation_;  ///< displacement by separate_overlaps, by slot; empty where nothing overlaps
    AlignedVector<Real> volume_, inverse_mass_, mobility_, solid_, density_, max_speed_square_, response_, target_,
        impulse_, impulse_sum_, zeroth_order_correction_;
    Vector3Array<Real> zeroth_;
    std::array<AlignedVector<Real>, 6> correction_;
    AlignedVector<Real> packed_, packed_velocity_, packed_correction_, packed_shear_, packed_zeroth_order_;
    std::vector<int> row_begin_, neighbour_count_;
    AlignedVector<std::int32_t> neighbour_;
    AlignedVector<Real> distance_;
    Vector3Array<Real> gradient_;

    std::vector<Vec3<Real>> impulse_on_;  ///< of the water, by particle; empty unless forces are kept
    Real impulse_time_ = 0;               ///< over which it was summed, s

    NeighbourLists<Real> lists_;
};

}  // namespace natator::cpu
