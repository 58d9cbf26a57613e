#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "natator/scene.h"
#include "natator/solver.h"

/// What the tests of the solver's parameters share: particles with all else off, both schemes, both precisions.
namespace natator::test {

using Points = std::vector<Eigen::Vector3d>;

inline constexpr double substep = 1.0 / 240;
inline constexpr std::uint32_t fluid_phase = 2u | phase::self_collide | phase::fluid;
inline constexpr std::uint32_t solid_phase = 1u | phase::self_collide;

/// Particles with every force and limit off, advanced by one substep an update.
inline Model bare_model(Scheme scheme, Points positions, std::uint32_t phase) {
    Model model;
    model.scheme = scheme;
    SolverParameters& p = model.parameters;
    p = thesis_tank().solver;
    p.gravity.setZero();
    p.dynamic_friction = p.particle_friction = 0;
    p.damping = p.flex.viscosity = 0;
    p.max_acceleration = p.max_speed;
    p.substeps = 1;
    model.time_step = substep;
    model.position = std::move(positions);
    model.velocity.assign(model.position.size(), Eigen::Vector3d::Zero());
    model.inverse_mass.assign(model.position.size(), 1.0);
    model.phase.assign(model.position.size(), phase);
    return model;
}

/// The same in scheme `conserving`, with the limit on acceleration that overlaps are pushed apart at.
inline Model overlapping(Points positions, std::uint32_t phase) {
    Model model = bare_model(Scheme::conserving, std::move(positions), phase);
    model.parameters.max_acceleration = 100;
    return model;
}

/// A lattice of nx * ny * nz points around `centre`.
inline Points lattice(int nx, int ny, int nz, double spacing, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
    Points points;
    const Eigen::Vector3d middle = 0.5 * Eigen::Vector3d(nx - 1, ny - 1, nz - 1);
    for (int x = 0; x < nx; ++x)
        for (int y = 0; y < ny; ++y)
            for (int z = 0; z < nz; ++z) points.push_back(centre + spacing * (Eigen::Vector3d(x, y, z) - middle));
    return points;
}

template <class Real>
void advance(Solver<Real>& solver, State<Real>& state, int substeps) {
    for (int k = 0; k < substeps; ++k) ASSERT_FALSE(solver.update(state, substep, 1));
}

template <class Real>
State<Real> run(const Model& model, int substeps) {
    Solver<Real> solver(model);
    State<Real> state = initial_state<Real>(model);
    advance(solver, state, substeps);
    return state;
}

template <class Real>
Eigen::Vector3d momentum(const Model& model, const State<Real>& state) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < model.particles(); ++i)
        sum += state.velocity[i].template cast<double>() / model.inverse_mass[i];
    return sum;
}

/// Sum of |m v|, what a momentum error is relative to.
template <class Real>
double momentum_size(const Model& model, const State<Real>& state) {
    double sum = 0;
    for (int i = 0; i < model.particles(); ++i)
        sum += static_cast<double>(state.velocity[i].norm()) / model.inverse_mass[i];
    return sum;
}

class EffectTest : public testing::TestWithParam<Scheme> {
protected:
    /// The scheme's tests run in both precisions.
    template <class Test>
    void in_both_precisions(const Test& test) const {
        test(float{});
        test(double{});
    }
};

inline std::string scheme_name(const testing::TestParamInfo<Scheme>& scheme) {
    return scheme.param == Scheme::flex ? "flex" : "conserving";
}

}  // namespace natator::test
