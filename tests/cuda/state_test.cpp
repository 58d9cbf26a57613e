// Simulations on a GPU, saved and gone on from.
#include <cmath>

#include "../native/coarse_lake.h"
#include "../native/refusal_of.h"
#include "gpu_test.h"
#include "natator/measure.h"
#include "natator/simulation.h"

namespace natator {
namespace {

using nlohmann::json;
using GpuState = test::OnGpu<>;

/// Of each scheme one, by its name.
SimulationSetup setup_of(const std::string& scheme) {
    const bool lake = scheme == "lattice";
    const json overrides = lake ? test::coarse_lake : json{{"scheme", scheme}, {"settling", {{"updates", 2}}}};
    return {lake ? "lake/creature-2" : "bench/small-tank", overrides.dump()};
}

TEST_F(GpuState, GoesOnWithTheSameBits) {
    Execution on_gpu;
    on_gpu.gpu = 0;
    for (const char* scheme : {"flex", "conserving", "lattice"}) {
        Simulation<float> first(setup_of(scheme), on_gpu), second(setup_of(scheme), on_gpu);
        first.set_gait(test::wave(first.scene()));
        for (int frame = 0; frame < 4; ++frame) ASSERT_TRUE(first.step());
        const std::string saved = first.save();
        EXPECT_TRUE(second.restore(saved));
        EXPECT_EQ(second.save(), saved) << scheme;
        for (int frame = 0; frame < 4; ++frame) {
            ASSERT_TRUE(first.step());
            ASSERT_TRUE(second.step());
        }
        EXPECT_EQ(state_hash(first.state()), state_hash(second.state())) << scheme;
        const std::string later = first.save();
        EXPECT_EQ(second.save(), later) << scheme;
        EXPECT_FALSE(first.restore(saved));
        for (int frame = 0; frame < 4; ++frame) ASSERT_TRUE(first.step());
        EXPECT_EQ(first.save(), later) << scheme;
    }
}

TEST_F(GpuState, WaterOfTheCpuIsRefused) {
    Execution on_gpu;
    on_gpu.gpu = 0;
    Simulation<float> here(setup_of("lattice")), there(setup_of("lattice"), on_gpu);
    here.step();
    there.step();
    EXPECT_EQ(test::refusal_of([&] { there.restore(here.save()); }),
              "state: its water is not of this lattice on this kind of processor");
    EXPECT_EQ(test::refusal_of([&] { here.restore(there.save()); }),
              "state: its water is not of this lattice on this kind of processor");
}

}  // namespace
}  // namespace natator
