// The effects that the thesis leaves off: on the GPU as on the CPU, by a block and by the whole GPU.
#include "gpu_test.h"
#include "natator/gpu_solver.h"
#include "natator/model_builder.h"

namespace natator::test {
namespace {

struct Effect {
    const char* name;
    double SolverParameters::*strength;
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
    EXPECT_GT(largest_distance(cpu, after_two_frames(scene, without, Solver<double>(without))), 1e-6);
    for (const GpuPath path : {GpuPath::block, GpuPath::whole_gpu}) {
        if (path == GpuPath::block && scheme == Scheme::conserving) continue;  // has no other than the whole GPU
        const State<double> gpu = after_two_frames(scene, model, GpuSolver<double>(model, {.path = path}));
        EXPECT_LE(largest_distance(cpu, gpu), 1e-9) << "path " << static_cast<int>(path);
        double velocities_apart = 0;
        for (std::size_t i = 0; i < cpu.velocity.size(); ++i)
            velocities_apart = std::max(velocities_apart, (cpu.velocity[i] - gpu.velocity[i]).norm());
        EXPECT_LE(velocities_apart, 1e-6) << "path " << static_cast<int>(path);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, GpuEffects,
    testing::Combine(testing::Values(Effect{"Restitution", &SolverParameters::restitution, 0.5},
                                     Effect{"Adhesion", &SolverParameters::adhesion, 50},
                                     Effect{"Sleep", &SolverParameters::sleepThreshold, 0.2},
                                     Effect{"ShockPropagation", &SolverParameters::shockPropagation, 1.5},
                                     Effect{"Dissipation", &SolverParameters::dissipation, 3},
                                     Effect{"Cohesion", &SolverParameters::cohesion, 0.02},
                                     Effect{"SurfaceTension", &SolverParameters::surfaceTension, 0.5},
                                     Effect{"Vorticity", &SolverParameters::vorticityConfinement, 0.5},
                                     Effect{"FreeSurfaceDrag", &SolverParameters::freeSurfaceDrag, 1}),
                     testing::Values(Scheme::flex, Scheme::conserving)),
    case_name);

}  // namespace
}  // namespace natator::test
