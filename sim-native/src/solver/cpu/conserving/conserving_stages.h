#pragma once

#include "../substep.h"
#include "constants.h"
#include "density_kernels.h"
#include "physics/pbf_density.h"

namespace natator::cpu {

/// The density constraints of both particles of a pair correct the pair, each in full if it were alone. Half of each
/// makes a collision inelastic (restitution 0); the whole of both would make it elastic, and a fluid at rest boil.
template <class Real>
inline constexpr Real pair_share = Real(physics::pair_share);

/// The stages of scheme `conserving`: each group of constraints in turn, within a group all at once with split masses
/// (Tonge, Benevolenski, Voroshilov: Mass Splitting for Jitter-Free Parallel Rigid Body Simulation, 2012), so that
/// internal forces keep linear and angular momentum. Stiffness enters as XPBD compliance (Macklin, Müller, Chentanez:
/// XPBD, 2016), so that it means the same at any substep and iteration count.
template <class Real>
class ConservingStages : public Substep<Real> {
public:
    static constexpr Scheme scheme = Scheme::conserving;

    ConservingStages(const Model& model, const Plan& plan);

    void predict();
    void find_fluid_neighbours();
    template <class AfterStage>
    void find_neighbours(const AfterStage& after) {
        this->find_neighbours_of(*this, plan_, after);
    }
    void begin_iterations();
    void solve_density_constraint();
    void solve_contacts();
    void solve_springs();
    void solve_clusters();
    void solve_planes();
    void keep_body_momentum();
    void solve_density_rate();
    void update_velocities();
    /// Work of the changes of rest length from `before` to those of the last substep, mass length^2/s^2.
    double spring_work(const std::vector<Real>& before) const;

    /// Density at the present positions by particle, in units of rest density; 0 for solids and infinite masses.
    std::vector<Real> densities() {
        if (plan_.fluid) {
            const AlignedVector<Real> lambda_sum = lambda_sum_;
            compute_lambda();
            lambda_sum_ = lambda_sum;
        }
        return this->densities_by_particle();
    }
    std::vector<Real> pressures() const;

private:
    void compute_lambda();
    void compute_lambda_of_fluid(const DensityView<Real>& fluid);
    void solve_density_constraint_of_fluid();
    bool find_overlap();
    void limit_overlap_pressure();
    Real contact_depth(int i, int j) const;
    physics::FluidKernel<Real> fluid_kernel() const {
        return {own_.kernel_scale, own_.gradient_scale, own_.rest_sum};
    }
    void clear_boundary_terms();
    void add_plane_pressure();
    void push_from_planes();
    PlanePressure<Real> plane_pressure();
    void add_solid_pressure();
    void push_solids_by_pressure();
    DensityView<Real> density_view();
    /// Moves slot by omega * share times its correction, which is 0 again afterwards.
    void apply_correction(int slot, Real share = 1);
    /// Applies the corrections of springs or clusters and books them as internal to their body.
    void apply_internal_corrections();
    /// Particles that springs and clusters hang together; none of infinite mass.
    struct FreeBody {
        std::vector<int> particles;
        Vec3<double> linear{};   ///< velocity to add, so that internal forces kept momentum
        Vec3<double> angular{};  ///< angular velocity to add, about `centre`
        Vec3<double> centre{};
    };

    const DensityKernels<Real>* density_kernels_;
    ConservingConstants<Real> own_;
    Real overlap_push_ = 0;                                  ///< how far a substep may push overlaps apart, length
    bool looked_for_overlap_ = false, overlapping_ = false;  ///< in this substep
    AlignedVector<Real> lambda_, response_, lambda_sum_, solid_gradient_square_;
    AlignedVector<Real> overlap_;         ///< C_i at the start of the substep if it is an overlap, else 0
    AlignedVector<Real> overlap_lambda_;  ///< what has pushed it out in this substep
    Vector3Array<Real> solid_gradient_;
    std::vector<Real> contact_depth_;  ///< by contact

    std::vector<int> bonded_;              ///< particles in springs or clusters
    std::vector<Vec3<Real>> internal_;     ///< by particle: its displacement by springs and clusters
    std::vector<FreeBody> bodies_;
    std::vector<int> springs_per_particle_;  ///< n of the springs' mass splitting
    std::vector<Real> spring_lambda_;
    std::vector<std::vector<Real>> cluster_mass_;                ///< m_j / n_j per member
    std::vector<std::vector<Vec3<Real>>> cluster_displacement_;  ///< sum of the substep's corrections per member

protected:
    /// x, or where it is put that is behind a plane or nearer to one than `distance`: see physics::put_before.
    Vec3<Real> before_planes(Vec3<Real> x, Real distance) const;
    void move(int slot, const Vec3<Real>& by) {
        displacement_.add(slot, by);
        ws_.position.set(slot, base_.at(slot) + displacement_.at(slot));
    }

    Vector3Array<Real> base_;          ///< predicted positions by slot
    Vector3Array<Real> displacement_;  ///< from base_ to the present position, apart so that it is not rounded to it

    using Substep<Real>::model_;
    using Substep<Real>::plan_;
    using Substep<Real>::constants_;
    using Substep<Real>::ws_;
    using Substep<Real>::state_;
    using Substep<Real>::h_;
    using Substep<Real>::inverse_mass_;
    using Substep<Real>::cluster_offset_;
    using Substep<Real>::cluster_rotation_;
    using Substep<Real>::cluster_centre_;
    using Substep<Real>::position_of_slot;
    using Substep<Real>::start_of_slot;
};

}  // namespace natator::cpu
