// Scheme flex on the GPU against black-box measurements of NVIDIA Flex 1.2.0, with the bounds that hold on the CPU.
#include "../native/conformance_checks.h"
#include "gpu_test.h"

namespace natator::test {
namespace {

json on_gpu(const json& experiment, const std::string& name) {
    return run_particle_experiment(experiment, name, Precision::single_precision, 0);
}

/// What no rounding can meet.
json exceptions() {
    return read(conformance_dir / "exceptions.json");
}

class GpuMicro : public OnGpu<testing::TestWithParam<std::string>> {};
TEST_P(GpuMicro, PositionsAgreeAfterEveryIteration) {
    expect_positions_after_every_iteration(GetParam(), exceptions(), on_gpu);
}
TEST_P(GpuMicro, VelocitiesAgreeAfterTheFirstUpdate) {
    expect_velocities_after_the_first_update(GetParam(), exceptions(), on_gpu);
}
INSTANTIATE_TEST_SUITE_P(Flex, GpuMicro, testing::ValuesIn(files_of("micro")), [](const auto& p) { return p.param; });

class GpuOneFrame : public OnGpu<testing::TestWithParam<std::string>> {};
TEST_P(GpuOneFrame, EveryParticleAgrees) {
    expect_every_particle_after_a_frame(GetParam(), on_gpu);
}
INSTANTIATE_TEST_SUITE_P(Flex, GpuOneFrame, testing::ValuesIn(files_of("one_frame")),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace natator::test
