#pragma once

#include <array>
#include <optional>
#include <utility>

#include "fluid_kernels.h"
#include "natator/plan.h"
#include "natator/solver.h"
#include "workspace.h"

namespace natator::cpu {

/// Solver parameters as the stages use them: in Real, with what follows from them.
template <class Real>
struct Constants {
    explicit Constants(const SolverParameters& parameters);

    Real radius, inverse_radius;
    Real search_distance;  ///< radius + particleCollisionMargin
    Real solid_rest_distance;
    Real density_scale;  ///< 1/S: makes the density of the rest packing 1
    Real dynamic_friction, static_friction, particle_friction;
    Real collision_distance, plane_search_distance;
    Real relaxation_factor;
    Real max_speed;
};

/// The vector, shortened to `longest` if it is longer.
template <class Real>
Vector3<Real> clamped(const Vector3<Real>& vector, Real longest) {
    const Real length = vector.norm();
    return length > longest ? Vector3<Real>(vector * (longest / length)) : vector;
}

/// The stages of one substep of scheme `flex` on the CPU, one source file each; step.h gives their order.
/// The equations are those measured on NVIDIA Flex 1.2.0 (tests/conformance/README.md).
template <class Real>
class Stages {
public:
    explicit Stages(const Model& model);

    const Plan& plan() const { return plan_; }
    const Workspace<Real>& workspace() const { return ws_; }

    /// Takes the state that the coming substep of length h (s) starts from and writes back to.
    void begin_substep(State<Real>& state, Real h) {
        state_ = &state;
        h_ = h;
    }

    void predict();
    void sort_into_cells();
    void gather_slots();
    void find_fluid_neighbours();
    void find_contacts();
    void find_plane_contacts();

    void clear_corrections();
    void compute_density();
    void solve_density_constraint();
    void solve_contacts();
    void solve_springs();
    void solve_clusters();
    void relax_and_apply();
    void solve_planes();

    void update_velocities();

    /// False if the last substep's outcome is not finite.
    bool finite() const;
    /// Lowest particle whose position, correction or velocity is not finite at this point of the substep.
    std::optional<int> first_not_finite() const;
    /// Writes the substep's outcome into the state; particles of infinite mass keep theirs.
    void commit();

    /// Positions by particle at this point of the substep.
    std::vector<Vector3<Real>> positions() const;
    /// Density at the present positions by particle, in units of rest density; 0 for solids and infinite masses.
    std::vector<Real> densities();
    /// Fluid neighbours and contacts by particle.
    std::vector<int> neighbour_counts() const;

private:
    bool collides(int i, int j) const;
    FluidView<Real> fluid_view();
    void add_correction(int slot, const Vector3<Real>& correction);
    Vector3<Real> position_of_slot(int slot) const {
        return {ws_.position.x[slot], ws_.position.y[slot], ws_.position.z[slot]};
    }
    Vector3<Real> start_of_slot(int slot) const { return {ws_.start.x[slot], ws_.start.y[slot], ws_.start.z[slot]}; }

    const Model& model_;
    Plan plan_;
    Constants<Real> constants_;
    Workspace<Real> ws_;
    const FluidKernels<Real>* kernels_;
    State<Real>* state_ = nullptr;
    Real h_ = 0;

    std::vector<Real> inverse_mass_;  ///< by particle
    std::vector<Real> spring_stiffness_;
    std::vector<std::vector<Vector3<Real>>> cluster_offset_;
    std::vector<Eigen::Quaternion<Real>> cluster_rotation_;  ///< of the running substep
    std::vector<Vector3<Real>> cluster_centre_;

    std::array<std::vector<std::int32_t>, lanes> found_;  ///< room for the neighbours of one block
    std::vector<std::pair<int, int>> pairs_;              ///< room for the contacts of one substep
};

}  // namespace natator::cpu
