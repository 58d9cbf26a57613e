#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "fluid_kernels.h"
#include "motion_kernels.h"
#include "natator/solver.h"
#include "neighbour_lists.h"
#include "physics/contact.h"
#include "physics/spring.h"
#include "plane_kernels.h"
#include "solver/muscle_work.h"
#include "solver/step.h"
#include "thread_team.h"
#include "workspace.h"

namespace natator::cpu {

/// Solver parameters as the stages use them: in Real, with what follows from them.
template <class Real>
struct Constants {
    explicit Constants(const SolverParameters& parameters);

    Real radius, inverse_radius;
    Real search_distance;  ///< radius + particle_collision_margin
    Real solid_rest_distance;
    Real density_scale;  ///< 1/S: makes the density of the rest packing 1
    Real dynamic_friction, static_friction, particle_friction;
    Real collision_distance, plane_search_distance;
    Real relaxation_factor;
    Real max_speed;
    Real cohesion_slope;     ///< b, see physics::cohesion_pull
    Real gradient_estimate;  ///< G, see physics::gradient_part; 0 without fluid
};

/// What all schemes do in a substep on the CPU, one source file per stage, and what they share to do it.
/// step.h gives the order of the stages.
template <class Real>
class Substep {
public:
    Substep(const Model& model, const Plan& plan);

    const Plan& plan() const { return plan_; }
    const Workspace<Real>& workspace() const { return ws_; }

    /// Shares the loops over many particles among this many threads; the bits that come out are the same.
    void use_threads(int threads) { team_ = std::make_unique<ThreadTeam>(threads); }

    /// Takes the state that the coming substep of length h (s) starts from and writes back to.
    void begin_substep(State<Real>& state, Real h) {
        state_ = &state;
        h_ = h;
    }

    static constexpr Grouping grouping = Grouping::separate;
    static constexpr bool effects = true;

    void predict();
    /// Numbers slots by cell; without pairs to search slots keep their numbers.
    void sort_into_cells() {
        if (plan_.fluid || plan_.contacts) number_slots();
        gather_slots();
    }
    void find_fluid_neighbours();
    void find_contacts();
    void find_plane_contacts();

    // Stages after the velocities, cpu/effects.
    void damp_contacts();
    void drag_free_surface();
    void apply_fluid_forces();
    void apply_adhesion();
    void apply_restitution();
    void apply_sleep();

    /// False if the last substep's outcome is not finite.
    bool finite() const;
    /// Empties what the last substep left, so that first_not_finite sees only what the coming one computes.
    void forget();
    /// Lowest particle whose position, correction or velocity is not finite at this point of the substep.
    std::optional<int> first_not_finite() const;
    /// Writes the substep's outcome into the state; particles of infinite mass keep theirs.
    void commit();

    // Defaults for scheme flex, which knows no forces; ConservingStages hides them.
    /// Work of the last substep's changes of rest length, mass length^2/s^2.
    MuscleWork spring_work(const std::vector<Real>&) const { return {}; }
    void measure_divergence(Residuals&) {}
    /// Begins to sum the water's forces on the particles, see Solver::forces.
    void keep_forces() {}
    void clear_forces() {}
    std::vector<Vector3<Real>> forces() const { return {}; }

    /// Positions by particle at this point of the substep.
    std::vector<Vector3<Real>> positions() const;
    /// Fluid neighbours and contacts by particle.
    std::vector<int> neighbour_counts() const;

protected:
    /// The searches in their order, by the stages of a scheme.
    template <class Stages, class AfterStage>
    static void find_neighbours_of(Stages& stages, const Plan& plan, const AfterStage& after) {
        if (plan.fluid) {
            stages.find_fluid_neighbours();
            after(Stage::fluid_neighbours);
        }
        if (plan.contacts) stages.find_contacts();
        if (plan.planes) stages.find_plane_contacts();
    }
    /// Does particle i feel particle j?
    bool collides(int i, int j) const;
    FluidView<Real> fluid_view();  ///< of all blocks
    MotionView<Real> motion_view();

    /// Calls work(view of some blocks) until all blocks of the view are done, on all threads.
    template <class View, class Work>
    void on_all_threads(View view, const Work& work) {
        team_->for_parts(view.end_block, min_part, [&](int, int begin, int end) {
            View part = view;
            part.first_block = begin;
            part.end_block = end;
            work(part);
        });
    }
    /// Calls work(slot) for all slots in use, on all threads.
    template <class Work>
    void for_each_slot(const Work& work) {
        team_->for_parts(ws_.all_blocks(), min_part, [&](int, int begin, int end) {
            for (int slot = begin * lanes; slot < std::min(end * lanes, ws_.fluid); ++slot) work(slot);
            for (int slot = std::max(begin * lanes, ws_.solid_begin); slot < std::min(end * lanes, ws_.slots); ++slot)
                work(slot);
        });
    }
    static constexpr int min_part = 512;  ///< blocks; fewer are done before another thread is awake
    PlaneView<Real> plane_view(int plane) const;
    NearPlanes<Real> near_planes();
    /// Calls work(block, chosen lanes, plane) for what is near planes, last plane first, in the first blocks.
    template <class Work>
    void for_each_plane_group(int end_block, const Work& work) const {
        PlaneView<Real> view{};
        int viewed = -1;
        for (const auto& [plane, block, chosen] : ws_.plane_groups) {
            if (block >= end_block) continue;
            if (plane != viewed) view = plane_view(plane);
            viewed = plane;
            work(block, chosen, view);
        }
    }
    /// Moves what is near planes out of them, see physics::resolve_plane_penetration.
    void resolve_plane_penetrations(const NearPlanes<Real>& slots) {
        for_each_plane_group(ws_.all_blocks(), [&](int block, unsigned chosen, const PlaneView<Real>& plane) {
            plane_kernels_->resolve_penetration(slots, block, chosen, plane);
        });
    }
    /// Densities of the fluid by particle as the last density stage left them; 0 for solids and infinite masses.
    std::vector<Real> densities_by_particle() const;
    Vec3<Real> position_of_slot(int slot) const { return ws_.position.at(slot); }
    Vec3<Real> start_of_slot(int slot) const { return ws_.start.at(slot); }

    const Model& model_;
    Plan plan_;
    Constants<Real> constants_;
    Workspace<Real> ws_;
    State<Real>* state_ = nullptr;
    Real h_ = 0;

    /// Friction rule of contacts between particles.
    physics::Friction<Real> particle_friction() const {
        return {plan_.particle_friction, constants_.static_friction, constants_.particle_friction};
    }
    /// Displacement of a slot by a contact of this depth, before its share is taken.
    Vec3<Real> contact_push(int slot, int other, Real depth) const {
        const Vec3<Real> difference = position_of_slot(slot) - position_of_slot(other);
        return physics::contact_push(difference, norm(difference), depth, particle_friction(), [&] {
            return (position_of_slot(slot) - start_of_slot(slot)) - (position_of_slot(other) - start_of_slot(other));
        });
    }
    /// Inverse mass of contact partner `other` as `slot` feels it: shock propagation changes it.
    Real partner_weight(int slot, int other) const {
        const Real w = ws_.inverse_mass[other];
        if (!plan_.shock_propagation) return w;
        return w * physics::shock_factor(up_, static_cast<Real>(model_.parameters.shock_propagation),
                                         start_of_slot(slot) - start_of_slot(other));
    }
    /// Calls visit(other slot, vector from other to this, r, q = r/R) for the fluid neighbours with 0 < r < R.
    template <class Visit>
    void for_each_fluid_neighbour(int slot, const Visit& visit) const;

    int max_neighbours_;                    ///< fluid neighbours kept per particle
    std::vector<Real> inverse_mass_;        ///< by particle
    Vec3<Real> up_;                         ///< against gravity; 0 without it
    std::vector<Vec3<Real>> new_velocity_;  ///< by particle, the substep's outcome
    std::vector<physics::SpringRule<Real>> spring_rules_;
    std::vector<std::vector<Vec3<Real>>> cluster_offset_;
    std::vector<Eigen::Quaternion<Real>> cluster_rotation_;  ///< of the running substep
    std::vector<Vec3<Real>> cluster_centre_;
    std::unique_ptr<ThreadTeam> team_ = std::make_unique<ThreadTeam>(1);
    const FluidKernels<Real>* kernels_;
    const NeighbourKernels<Real>* neighbour_kernels_;
    const MotionKernels<Real>* motion_kernels_;
    const PlaneKernels<Real>* plane_kernels_;

private:
    void add_surface_tension();
    void add_vorticity_confinement();

    void number_slots();
    void gather_slots();
    void sort_by_cell(const std::vector<int>& ids, int first_slot, std::vector<int>& cell_begin);
    std::vector<std::vector<int>> next_slot_;  ///< by part of the particles and cell, room for the sort

    std::vector<Vec3<Real>> velocity_change_;  ///< by particle; empty unless an effect needs it
    std::vector<Vec3<Real>> normal_, curl_;    ///< by fluid slot; empty unless an effect needs them
    std::vector<int> overlaps_;                ///< by slot; empty unless an effect needs it

    NeighbourLists<Real> lists_;
    std::vector<std::int32_t> found_contacts_;  ///< room for the contacts of one particle
    std::vector<std::pair<int, int>> pairs_;    ///< room for the contacts of one substep
};

}  // namespace natator::cpu
