#pragma once

#include <optional>

#include "solids.h"
#include "solver/cpu/substep.h"
#include "solver/water/cpu/water.h"

namespace natator::cpu {

/// The stages of scheme `conserving`. Each iteration is a pass of the water's density solve, on velocities, and then
/// one of the solids' constraints, on positions, so that both see what the other has done. Of the solids each group of
/// constraints comes in turn, within a group all at once with split masses (Tonge, Benevolenski, Voroshilov: Mass
/// Splitting for Jitter-Free Parallel Rigid Body Simulation, 2012), so that internal forces keep linear and angular
/// momentum. Stiffness enters as XPBD compliance (Macklin, Müller, Chentanez: XPBD, 2016), so that it means the same at
/// any substep and iteration count.
template <class Real>
class ConservingStages : public Substep<Real> {
public:
    static constexpr Scheme scheme = Scheme::conserving;

    ConservingStages(const Model& model, const Plan& plan);

    void find_water_neighbours();
    void compute_water_gradients() { water_->compute_gradients(*this->team_); }
    bool begin_overlap_separation() { return water_->begin_overlap_separation(*this->team_); }
    void separate_overlaps(int) { water_->separate_overlaps(*this->team_); }
    void end_overlap_separation() { water_->end_overlap_separation(*this->team_); }
    void solve_divergence() { water_->solve_divergence(*this->team_); }
    void add_viscosity() { water_->add_viscosity(*this->team_); }
    void add_fluid_forces() { water_->add_forces(*this->team_); }
    void predict();
    template <class AfterStage>
    void find_neighbours(const AfterStage&) {
        if (plan_.contacts) this->find_contacts();
        if (plan_.planes) find_plane_contacts();
    }
    void begin_iterations();
    void compute_density_impulses();
    /// Whether the last iteration found the density within its tolerance.
    bool has_converged() const { return !water_ || density_error_ <= model_.parameters.conserving.density_tolerance; }
    void apply_density_impulses();
    void return_zeroth_order_correction();
    void apply_wall_pressure() { water_->apply_wall_pressure(*this->team_); }
    void add_pressure_forces() { water_->add_pressure_forces(); }
    void move_water();
    void solve_contacts();
    void solve_springs();
    void solve_clusters();
    void solve_planes();
    void update_velocities();
    /// Work of the changes of rest length from `before` to those of the last substep, mass length^2/s^2.
    MuscleWork spring_work(const std::vector<Real>& before) const;

    /// At the last substep's start, by particle, in units of rest density; 0 for solids and infinite masses.
    std::vector<Real> densities() const;
    std::vector<Real> pressures() const;
    std::vector<int> neighbour_counts() const;

    /// Measures the residual of the divergence after its stage, and of all other constraints after an iteration.
    void measure_divergence(Residuals& residuals) {
        residuals.divergence = water_->measure_target_residual(*this->team_);
    }
    void measure_constraints(Residuals& residuals);

    /// See Solver::forces; empty without water.
    void keep_forces() {
        if (water_) water_->keep_forces();
    }
    void clear_forces() {
        if (water_) water_->clear_forces();
    }
    std::vector<Vector3<Real>> forces() const { return water_ ? water_->forces() : std::vector<Vector3<Real>>{}; }

private:
    /// Calls work(i) for each particle, side by side.
    template <class Work>
    void for_each_particle(const Work& work) {
        this->team_->for_each(ws_.particles, this->min_part * lanes, work);
    }
    void send_velocities_to_water();
    void move_solids_with_water();
    /// Water that has left a periodic tank comes in at the other end.
    void wrap_fluid();
    void put_before_planes();
    void find_plane_contacts();
    Real contact_depth(int i, int j) const;
    void keep_body_momentum();
    /// Moves slot by omega times its correction, which is 0 again afterwards.
    void apply_correction(int slot);
    /// Applies the corrections of springs or clusters and books them as internal to their body.
    void apply_internal_corrections();
    /// x, or where it is put that is behind a plane or nearer to one than `distance`: see physics::put_before.
    Vec3<Real> before_planes(Vec3<Real> x, Real distance) const;
    /// Distance that a particle keeps from planes, length. Water does not touch them otherwise: their ghosts hold it.
    Real wall_distance(int particle) const;
    void move(int slot, const Vec3<Real>& by) {
        displacement_.add(slot, by);
        ws_.position.set(slot, base_.at(slot) + displacement_.at(slot));
    }
    /// Velocity of a particle as the iterations have left it, length/s.
    Vec3<Real> present_velocity(int particle) const {
        const int slot = ws_.slot_of[particle];
        return ws_.predicted_velocity.at(slot) + 1 / h_ * displacement_.at(slot);
    }

    std::optional<Water<Real>> water_;
    std::vector<physics::PlaneSurface<Real>> planes_;
    std::vector<physics::PeriodicAxis<Real>> periodic_axes_;
    double density_error_ = 0;         ///< before the last iteration, see Residuals::density; with a tolerance alone
    Real overlap_push_ = 0;            ///< how far a substep may push overlaps apart, length
    Vector3Array<Real> base_;          ///< predicted positions by slot
    Vector3Array<Real> displacement_;  ///< from base_ to the present position, apart so that it is not rounded to it
    std::vector<Real> contact_depth_;  ///< by contact

    std::vector<int> bonded_;                ///< particles in springs or clusters
    std::vector<Vec3<Real>> internal_;       ///< by particle: its displacement by springs and clusters
    std::vector<std::vector<int>> bodies_;   ///< see free_bodies
    std::vector<int> springs_per_particle_;  ///< n of the springs' mass splitting
    std::vector<Real> spring_lambda_;
    std::vector<std::vector<Real>> member_mass_;                ///< m_j / n_j per member
    std::vector<std::vector<Vec3<Real>>> member_displacement_;  ///< sum of the substep's corrections per member

    using Substep<Real>::model_;
    using Substep<Real>::plan_;
    using Substep<Real>::constants_;
    using Substep<Real>::ws_;
    using Substep<Real>::state_;
    using Substep<Real>::h_;
    using Substep<Real>::inverse_mass_;
    using Substep<Real>::spring_rules_;
    using Substep<Real>::cluster_offset_;
    using Substep<Real>::cluster_rotation_;
    using Substep<Real>::cluster_centre_;
    using Substep<Real>::new_velocity_;
    using Substep<Real>::position_of_slot;
    using Substep<Real>::start_of_slot;
};

}  // namespace natator::cpu
