// Creature 1 of the thesis swims for a second in a small pool: a named scene with overrides, evaluated as a whole.
#include <cstdio>
#include <exception>
#include <vector>

#include "natator/natator.h"

int main() try {
    const natator::Scene scene =
        natator::load_scene("pool/creature-1", {.overrides = R"({"duration": 1})", .data = NATATOR_DATA_FOLDER});
    const natator::Gait gait{.frequency = 1.861, .amplitude = {0.973, 0.690}, .phase = {0, 0.648}};

    int frame = 0;
    std::puts("time (s)   mean x");
    const auto on_frame = [&frame](double time, const std::vector<Eigen::Vector3d>& body) {
        double mean_x = 0;
        for (const Eigen::Vector3d& x : body) mean_x += x.x() / static_cast<double>(body.size());
        if (frame++ % 12 == 0) std::printf("%8.1f   %6.3f\n", time, mean_x);
    };
    const natator::Evaluation result = natator::evaluate(scene, gait, {.on_frame = on_frame});

    std::printf("%s after %.2f s: swam %.4f units\n", natator::to_string(result.stopped), result.simulated,
                result.distance);
    return result.instability ? 1 : 0;
} catch (const std::exception& error) {  // a scene that is not there, a gait that does not fit it ...
    std::fprintf(stderr, "swimmer: %s\n", error.what());
    return 1;
}
