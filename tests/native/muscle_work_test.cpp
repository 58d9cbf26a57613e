// The work of muscles against the energy that it becomes.
#include <gtest/gtest.h>

#include <cmath>

#include "bare_particles.h"
#include "energy.h"
#include "natator/model.h"
#include "physics/constants.h"
#include "physics/spring.h"

namespace natator::test {
namespace {

constexpr double stiffness = 0.4;
const Gait gait{2, {0.6}, {0.1}, 1};

/// Two masses and the muscle between them.
Model pair_with_muscle(int substeps) {
    Model model = bare_model(Scheme::conserving, {{0, 0, 0}, {0.3, 0, 0}}, 1);
    model.inverse_mass = {1, 0.25};
    model.springs = {{0, 1, 0.3, stiffness}};
    model.muscles = {{0, 0, 1}};
    model.actuators = 1;
    model.time_step = 1.0 / 60;
    model.parameters.substeps = substeps;
    return model;
}

/// 1/2 k (l - l0)^2 with the spring's compliance 1/k = softness (w_a + w_b) h0^2.
double spring_energy(const Model& model, const State<double>& state) {
    const double h0 = physics::thesis_substep;
    const double k = 1 / (physics::softness(stiffness) * (model.inverse_mass[0] + model.inverse_mass[1]) * h0 * h0);
    const double strain = (state.position[1] - state.position[0]).norm() - state.spring_rest_length[0];
    return k * strain * strain / 2;
}

struct Balance {
    double work = 0, energy = 0;
};

Balance after_a_second(int substeps) {
    const Model model = pair_with_muscle(substeps);
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    for (int frame = 0; frame < 60; ++frame) EXPECT_FALSE(solver.frame(state, gait));
    return {solver.muscle_work(), kinetic_energy(model, state) + spring_energy(model, state)};
}

/// What the masses and the spring have, and what the time step takes off, is the muscle's work to rounding.
TEST(MuscleWork, IsTheEnergyGainedAndTheStepsDamping) {
    Model model = pair_with_muscle(1);
    model.time_step = substep;
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    const double h0 = physics::thesis_substep;
    const double k = 1 / (physics::softness(stiffness) * 1.25 * h0 * h0);
    const auto strain = [&] { return (state.position[1] - state.position[0]).norm() - state.spring_rest_length[0]; };
    double damped = 0;
    for (int frame = 0; frame < 240; ++frame) {
        const State<double> before = state;
        const double strain_before = strain();
        ASSERT_FALSE(solver.frame(state, gait));
        for (int i = 0; i < 2; ++i)
            damped += (state.velocity[i] - before.velocity[i]).squaredNorm() / model.inverse_mass[i] / 2;
        const double change = strain() - strain_before;
        damped += k * change * change / 2;
    }
    const double energy = kinetic_energy(model, state) + spring_energy(model, state);
    EXPECT_GT(solver.muscle_work(), 1e-2);
    EXPECT_NEAR(solver.muscle_work(), energy + damped, 1e-9 * solver.muscle_work());
}

/// The damping is of first order in the step: what is left of the work is the energy.
TEST(MuscleWork, BecomesTheEnergyAsTheStepGoesToZero) {
    const Balance coarse = after_a_second(32), fine = after_a_second(64);
    EXPECT_GT(fine.energy, 0);
    EXPECT_LT((fine.work - fine.energy) / fine.work, 0.6 * (coarse.work - coarse.energy) / coarse.work);
    EXPECT_GT(fine.work, fine.energy);
}

TEST(MuscleWork, IsNoneAtRestAndInSchemeFlex) {
    Model model = pair_with_muscle(4);
    Solver<double> resting(model);
    State<double> state = initial_state<double>(model);
    ASSERT_FALSE(resting.frame(state, resting_gait(1)));
    EXPECT_EQ(resting.muscle_work(), 0);
    EXPECT_TRUE(has_muscle_work(model));
    model.scheme = Scheme::flex;
    EXPECT_FALSE(has_muscle_work(model));
}

}  // namespace
}  // namespace natator::test
