// The effects that the thesis leaves off: on the GPU as on the CPU, by a block and by the whole GPU.
#include "../native/bare_particles.h"
#include "gpu_test.h"
#include "natator/model.h"
#include "solver/gpu_solver.h"

namespace natator::test {
namespace {

struct Effect {
    const char* name;
    double SolverParameters::* strength;
    double value;
};

using Case = std::tuple<Effect, Scheme>;

std::string case_name(const testing::TestParamInfo<Case>& info) {
    return std::string(std::get<0>(info.param).name) + name_of(std::get<1>(info.param));
}

class GpuEffects : public OnGpu<testing::TestWithParam<Case>> {
protected:
    /// Two frames from a start in which all fall.
    template <class AnySolver>
    static State<double> after_two_frames(const Scene& scene, const Model& model, AnySolver&& solver) {
        State<double> state = initial_state<double>(model);
        for (auto& v : state.velocity) v.y() -= 1;
        for (int frame = 0; frame < 2; ++frame) EXPECT_FALSE(solver.frame(state, wave(scene)));
        return state;
    }
};

TEST_P(GpuEffects, GiveWhatTheyGiveOnTheCpu) {
    const auto [effect, scheme] = GetParam();
    Scene scene = creature_scene(1, scheme);
    const Model without = build_model(scene);
    scene.solver.*effect.strength = effect.value;
    const Model model = build_model(scene);
    const State<double> cpu = after_two_frames(scene, model, Solver<double>(model));
    EXPECT_GT(max_distance(cpu, after_two_frames(scene, without, Solver<double>(without))), 1e-6);
    for (const GpuPath path : {GpuPath::block, GpuPath::whole_gpu}) {
        if (path == GpuPath::block && scheme == Scheme::conserving) continue;  // has no other than the whole GPU
        const State<double> gpu = after_two_frames(scene, model, GpuSolver<double>(model, {.path = path}));
        EXPECT_LE(max_distance(cpu, gpu), 1e-9) << "path " << static_cast<int>(path);
        double velocities_apart = 0;
        for (std::size_t i = 0; i < cpu.velocity.size(); ++i)
            velocities_apart = std::max(velocities_apart, (cpu.velocity[i] - gpu.velocity[i]).norm());
        EXPECT_LE(velocities_apart, 1e-6) << "path " << static_cast<int>(path);
    }
}

const Effect restitution{"Restitution", &SolverParameters::restitution, 0.5},
    adhesion{"Adhesion", &SolverParameters::adhesion, 50}, sleep{"Sleep", &SolverParameters::sleep_threshold, 0.2},
    shock_propagation{"ShockPropagation", &SolverParameters::shock_propagation, 1.5},
    dissipation{"Dissipation", &SolverParameters::dissipation, 3},
    cohesion{"Cohesion", &SolverParameters::cohesion, 0.02},
    surface_tension{"SurfaceTension", &SolverParameters::surface_tension, 0.5},
    vorticity{"Vorticity", &SolverParameters::vorticity_confinement, 0.5},
    free_surface_drag{"FreeSurfaceDrag", &SolverParameters::free_surface_drag, 1};

INSTANTIATE_TEST_SUITE_P(All, GpuEffects,
                         testing::Combine(testing::Values(adhesion, sleep, cohesion, surface_tension, vorticity,
                                                          free_surface_drag),
                                          testing::Values(Scheme::flex, Scheme::conserving)),
                         case_name);
/// In scheme conserving water has neither contacts nor planes, so that the scene feels nothing of these.
INSTANTIATE_TEST_SUITE_P(OfContacts, GpuEffects,
                         testing::Combine(testing::Values(restitution, shock_propagation, dissipation),
                                          testing::Values(Scheme::flex)),
                         case_name);

/// Grains that fall on the floor and on each other, without water.
class GpuEffectsOnGrains : public OnGpu<testing::TestWithParam<Effect>> {};

TEST_P(GpuEffectsOnGrains, AreTheCpus) {
    Model model = bare_model(Scheme::conserving, lattice(4, 4, 4, 0.14, {0.3, 0.35, 0.3}), solid_phase);
    for (int i = 0; i < model.particles(); ++i) {
        model.position[i] += 0.01 * Eigen::Vector3d(std::sin(1.7 * i), std::sin(2.3 * i), std::sin(3.1 * i));
        model.velocity[i] = {0, -1, 0};
    }
    model.parameters.gravity = {0, -10, 0};
    model.planes = {{{0, 1, 0}, 0}};
    const auto after_four_frames = [&](auto&& solver) {
        State<double> state = initial_state<double>(model);
        for (int frame = 0; frame < 4; ++frame) EXPECT_FALSE(solver.update(state, 4 * substep, 4));
        return state;
    };
    const State<double> without = after_four_frames(Solver<double>(model));
    model.parameters.*GetParam().strength = GetParam().value;
    const State<double> cpu = after_four_frames(Solver<double>(model));
    EXPECT_GT(max_distance(cpu, without), 1e-3);
    EXPECT_LE(max_distance(cpu, after_four_frames(GpuSolver<double>(model, {.path = GpuPath::whole_gpu}))), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, GpuEffectsOnGrains, testing::Values(restitution, sleep, shock_propagation, dissipation),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace natator::test
