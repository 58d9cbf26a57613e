// Scheme flex on the CPU against black-box measurements of NVIDIA Flex 1.2.0.
#include "conformance_checks.h"

namespace natator::test {
namespace {

json on_cpu(const json& experiment, const std::string& name) {
    return run_particle_experiment(experiment, name, Precision::single_precision);
}

json exceptions() {
    return read(conformance_dir / "exceptions.json");
}

class Micro : public testing::TestWithParam<std::string> {};
TEST_P(Micro, PositionsAgreeAfterEveryIteration) {
    expect_positions_after_every_iteration(GetParam(), exceptions(), on_cpu);
}
TEST_P(Micro, VelocitiesAgreeAfterTheFirstUpdate) {
    expect_velocities_after_the_first_update(GetParam(), exceptions(), on_cpu);
}
INSTANTIATE_TEST_SUITE_P(Flex, Micro, testing::ValuesIn(files_of("micro")), [](const auto& p) { return p.param; });

class OneFrame : public testing::TestWithParam<std::string> {};
TEST_P(OneFrame, EveryParticleAgrees) {
    expect_every_particle_after_a_frame(GetParam(), on_cpu);
}
INSTANTIATE_TEST_SUITE_P(Flex, OneFrame, testing::ValuesIn(files_of("one_frame")),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace natator::test
