// Starts that overlap, in scheme conserving: pushed apart without an explosion and without breaking the law of
// momentum.
#include "bare_particles.h"
#include "natator/measure.h"

namespace natator::test {
namespace {

template <class Real>
double fastest(const State<Real>& state) {
    double speed = 0;
    for (const auto& v : state.velocity) speed = std::max(speed, static_cast<double>(v.norm()));
    return speed;
}

/// A block at a fifth of its spacing, with more neighbours than lists hold. The speed is that of a gas that expands
/// into vacuum by a pressure p / rho of about max_acceleration times the rest distance: sqrt(2 p / rho), here 4.5.
TEST(OverlapTest, ACompressedBlockExpandsSlowlyAndKeepsItsMomentum) {
    Points positions = lattice(9, 9, 9, 0.02);
    positions.resize(600);  // not symmetric
    const Model model = overlapping(positions, fluid_phase);
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    double speed = 0;
    for (int k = 0; k < 240; ++k) {
        advance(solver, state, 1);
        speed = std::max(speed, fastest(state));
    }
    EXPECT_LT(speed, 2 * std::sqrt(2 * 100 * 0.1));
    EXPECT_GT(speed, 0.1);
    const Momentum momentum = measure_momentum(model, state);
    EXPECT_LE(momentum.linear, 1e-12 * momentum.linear_size);
    const std::vector<double> densities = solver.densities();
    EXPECT_LT(*std::max_element(densities.begin(), densities.end()), 1.2);
}

/// Two solid particles that start at a third of their distance: v^2 = 2 a s along the s that they are pushed.
TEST(OverlapTest, ADeepContactIsPushedAtTheLimitedAcceleration) {
    const Model model = overlapping({{-0.025, 0, 0}, {0.025, 0, 0}}, solid_phase);
    const State<double> state = run<double>(model, 60);
    const double apart = state.velocity[1].x() - state.velocity[0].x();
    EXPECT_NEAR(apart, std::sqrt(2 * 100 * 0.1), 0.1 * std::sqrt(2 * 100 * 0.1));
    EXPECT_NEAR(state.velocity[1].x(), -state.velocity[0].x(), 1e-12);
}

/// What starts behind a wall is put on it, and stays there.
TEST(OverlapTest, AParticleBehindAWallIsPutOnItWithoutVelocity) {
    Model model = overlapping({{0, -3, 0}, {1, 0.05, 0}}, solid_phase);
    model.planes = {{{0, 1, 0}, 0}};
    const State<double> state = run<double>(model, 10);
    EXPECT_NEAR(state.position[0].y(), model.parameters.collision_distance, 1e-12);
    EXPECT_NEAR(state.velocity[0].norm(), 0, 1e-12);
    EXPECT_EQ(state.position[1].y(), 0.05);
}

}  // namespace
}  // namespace natator::test
