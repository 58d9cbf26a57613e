#pragma once

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bench_scenes.h"
#include "natator/batch.h"
#include "natator/gait.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "scene/scene_json.h"
#include "solver/gpu_solver.h"

/// What the checks of the CUDA backend share. They skip themselves where there is no GPU.
namespace natator::test {

template <class Base = testing::Test>
class OnGpu : public Base {
protected:
    void SetUp() override {
        if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    }
};

inline Scene creature_scene(int creature, Scheme scheme, const char* suffix = "") {
    Scene scene = load_scene("thesis/creature-" + std::to_string(creature) + suffix);
    scene.scheme = scheme;
    return scene;
}

/// The thesis' tank with a block of so many particles along x, y and z, and walls behind it.
inline Scene tank_of(const std::array<int, 3>& count, Scheme scheme) {
    nlohmann::json overrides = bench::thesis_tank_with(count, 0.09);
    overrides["settling"]["updates"] = 3;
    Scene scene = load_scene("thesis/creature-1", overrides);
    scene.scheme = scheme;
    return scene;
}

/// A travelling wave along the body, different for each `number`.
inline Gait wave(const Scene& scene, int number = 0) {
    Gait gait;
    gait.frequency = 1 + 0.01 * number;
    for (int k = 0; k < scene.creature->actuators(); ++k) {
        gait.amplitude.push_back(0.9 - 0.001 * number);
        gait.phase.push_back(std::fmod(0.3 * k + 0.02 * number, 1.0));
    }
    return gait;
}

/// Of a particle's two places.
template <class Real>
double max_distance(const State<Real>& a, const State<Real>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.position.size(); ++i) {
        const double distance = (a.position[i] - b.position[i]).norm();
        if (!(distance <= largest)) largest = distance;  // also for NaN
    }
    return largest;
}

/// A model on the CPU and on the GPU, from the same start.
struct OnBoth {
    Solver<double> cpu;
    GpuSolver<double> gpu;
    State<double> on_cpu, on_gpu;

    explicit OnBoth(const Model& model, bool forces = false)
        : cpu(model, execution(forces)),
          gpu(model, {.forces = forces}),
          on_cpu(initial_state<double>(model)),
          on_gpu(on_cpu) {}

    /// Advances both; false if one is not stable.
    bool update(double time, int substeps) {
        return !cpu.update(on_cpu, time, substeps) && !gpu.update(on_gpu, time, substeps);
    }

private:
    static Execution execution(bool forces) {
        Execution chosen;
        chosen.forces = forces;
        return chosen;
    }
};

inline std::string name_of(Scheme scheme) {
    return scheme == Scheme::flex ? "flex" : "conserving";
}

}  // namespace natator::test
