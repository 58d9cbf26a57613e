// Simulations that share a GPU: each has the bits that it has alone, whatever the others do.
#include <cmath>
#include <memory>
#include <string>
#include <thread>

#include "../native/small_pair.h"
#include "gpu_test.h"
#include "natator/measure.h"
#include "natator/simulation.h"

namespace natator::test {
namespace {

class GpuTogether : public OnGpu<testing::TestWithParam<std::string>> {
protected:
    static SimulationSetup setup(int number) {
        SimulationSetup setup{.scene = "bench/small-tank", .start = number % 3};
        const std::string viscosity = number % 2 ? R"(, "solver": {"viscosity": 0.2})" : "";
        setup.overrides = R"({"settling": {"updates": 2}, "scheme": ")" + GetParam() + '"' + viscosity + "}";
        return setup;
    }
    using Swim = std::unique_ptr<Simulation<float>>;
    static Swim swim(int number, SharedGpu& gpu) {
        return std::make_unique<Simulation<float>>(setup(number), Execution{.gpu = 0, .shared = &gpu});
    }
    /// Changes with the frame; some follow their gait.
    static void steer(int number, int frame, Simulation<float>& swim) {
        if (number % 4 == 3) return;
        std::vector<double> drive;
        for (int k = 0; k < swim.model().actuators; ++k) drive.push_back(std::sin(0.9 * frame + number + k));
        swim.drive(drive);
    }
    static constexpr int frames = 6;
};

TEST_P(GpuTogether, EachHasTheBitsThatItHasAlone) {
    std::vector<std::uint64_t> alone;
    for (int number = 0; number < 9; ++number) {
        SharedGpu gpu;
        const Swim one = swim(number, gpu);
        for (int frame = 0; frame < frames; ++frame) {
            steer(number, frame, *one);
            EXPECT_TRUE(one->step());
        }
        alone.push_back(state_hash(one->state()));
    }
    SharedGpu gpu;
    std::vector<Swim> swims;
    for (int number = 0; number < 9; ++number) swims.push_back(swim(number, gpu));
    const auto go_on = [&](int group) {  // by a thread of its own
        for (int frame = 0; frame < frames; ++frame) {
            std::vector<Simulation<float>*> together;
            for (int number = group; number < 9; number += 2) {
                steer(number, frame, *swims[number]);
                if (number == 4 && frame == 2)
                    EXPECT_TRUE(swims[number]->step()) << "one goes by itself";
                else
                    together.push_back(swims[number].get());
            }
            for (const bool stable : step_together(together, 4)) EXPECT_TRUE(stable);
        }
    };
    std::thread other(go_on, 1);
    go_on(0);
    other.join();
    for (int number = 0; number < 9; ++number) EXPECT_EQ(state_hash(swims[number]->state()), alone[number]) << number;
}

/// Muscles are driven by the host: as on the CPU, to rounding.
TEST_P(GpuTogether, SteeringIsThatOfTheCpu) {
    SharedGpu gpu;
    const Swim there = swim(0, gpu);
    Simulation<float> here(setup(0));
    for (int frame = 0; frame < frames; ++frame) {
        steer(0, frame, *there);
        steer(0, frame, here);
        EXPECT_TRUE(there->step());
        EXPECT_TRUE(here.step());
    }
    EXPECT_LT(max_distance(there->state(), here.state()), 1e-3);
    EXPECT_NEAR(there->muscle_work(), here.muscle_work(), 1e-3 * std::abs(here.muscle_work()));
}

/// Two swimmers of one water, each driven by itself: to the bits of each alone, and as on the CPU to rounding.
TEST_P(GpuTogether, CompanionsAreDrivenByThemselves) {
    const auto company = [](int number) {
        nlohmann::json overrides = small_pair;
        overrides["scheme"] = GetParam();
        return SimulationSetup{.scene = "bench/small-tank", .overrides = overrides.dump(), .start = number % 3};
    };
    const auto steer_all = [](int number, int frame, Simulation<float>& swim) {
        for (int k = 0; k < swim.model().swimmers(); ++k)
            swim.drive(std::vector<double>(swim.model().actuators_of(k), std::sin(0.9 * frame + number + 2 * k)), k);
    };
    std::vector<std::uint64_t> alone;
    Simulation<float> here(company(0));
    for (int number = 0; number < 5; ++number) {
        SharedGpu gpu;
        Simulation<float> one(company(number), Execution{.gpu = 0, .shared = &gpu});
        for (int frame = 0; frame < frames; ++frame) {
            steer_all(number, frame, one);
            EXPECT_TRUE(one.step());
            if (number > 0) continue;
            steer_all(0, frame, here);
            EXPECT_TRUE(here.step());
        }
        alone.push_back(state_hash(one.state()));
        if (number > 0) continue;
        EXPECT_LT(max_distance(one.state(), here.state()), 1e-3);
        for (const int k : {0, 1}) {
            EXPECT_EQ(here.muscle_work(k) != 0, GetParam() != "flex");
            EXPECT_NEAR(one.muscle_work(k), here.muscle_work(k), 1e-3 * std::abs(here.muscle_work(k)));
        }
        EXPECT_TRUE(GetParam() == "flex" || here.muscle_work(0) != here.muscle_work(1));
    }
    SharedGpu gpu;
    std::vector<Swim> swims;
    for (int number = 0; number < 5; ++number)
        swims.push_back(std::make_unique<Simulation<float>>(company(number), Execution{.gpu = 0, .shared = &gpu}));
    std::string saved;
    for (int frame = 0; frame < frames; ++frame) {
        std::vector<Simulation<float>*> together;
        for (int number = 0; number < 5; ++number) {
            steer_all(number, frame, *swims[number]);
            together.push_back(swims[number].get());
        }
        if (frame == 3) saved = swims[2]->save();
        for (const bool stable : step_together(together, 4)) EXPECT_TRUE(stable);
    }
    for (int number = 0; number < 5; ++number) EXPECT_EQ(state_hash(swims[number]->state()), alone[number]) << number;
    Simulation<float> other(company(0), Execution{.gpu = 0, .shared = &gpu});
    EXPECT_TRUE(other.restore(saved));
    for (int frame = 3; frame < frames; ++frame) {
        steer_all(2, frame, other);
        EXPECT_TRUE(other.step());
    }
    EXPECT_EQ(state_hash(other.state()), alone[2]);
    EXPECT_EQ(other.muscle_work(1), swims[2]->muscle_work(1));
}

/// One that breaks a law stops; the others go on, and it can be started anew.
TEST_P(GpuTogether, WhatBecomesUnstableStandsStill) {
    SharedGpu gpu;
    SimulationSetup bad = setup(0);
    bad.overrides = R"({"settling": {"updates": 0}, "solver": {"gravity": [0, -1000, 0], "maxSpeed": 1e9}})";  // flex
    Simulation<float> falls(bad, Execution{.gpu = 0, .shared = &gpu});
    const Swim swims = swim(1, gpu);
    std::vector<bool> stable(2, true);
    for (int frame = 0; frame < frames; ++frame) stable = step_together<float>({&falls, swims.get()}, 2);
    EXPECT_FALSE(stable[0]);
    EXPECT_TRUE(falls.instability());
    EXPECT_TRUE(stable[1]);
    EXPECT_EQ(swims->frames(), frames);
    falls.load(setup(2));
    EXPECT_EQ(step_together<float>({&falls, swims.get()}, 2), std::vector<bool>(2, true));
}

INSTANTIATE_TEST_SUITE_P(Schemes, GpuTogether, testing::Values("flex", "conserving"),
                         [](const auto& scheme) { return scheme.param; });

}  // namespace
}  // namespace natator::test
