// A tadpole that this program drives: each frame it senses where its target is, and gives every actuator a value.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <vector>

#include "natator/natator.h"

namespace {

/// A wave from head to tail, and a bend to the side on which the target is.
std::vector<double> controller(int actuators, double time, const natator::Senses& senses) {
    const double to_right = senses.target->z();  // own axes: forward, up, right
    std::vector<double> values;
    for (int i = 0; i < actuators; ++i) {
        const double beat = 0.9 * std::sin(2 * std::numbers::pi * (2 * time - 0.16 * i));
        const double started = std::min(1.0, time / 0.25);  // a jump would strike the water
        values.push_back(started * (beat - std::clamp(2 * to_right, -0.5, 0.5)));
    }
    return values;
}

}  // namespace

int main() try {
    natator::Simulation tadpole(natator::load_scene("pool/tadpole", {.data = NATATOR_DATA_FOLDER}));
    const natator::Sensing sensing{.target = Eigen::Vector3d(2.2, 0.5, 0.8)};
    check_sensing(sensing, tadpole.model());

    std::puts("time (s)   to go   target to the right");
    while (tadpole.time() < 1) {
        const natator::Senses senses = sense(tadpole.model(), tadpole.state(), sensing);
        if (tadpole.frames() % 12 == 0)
            std::printf("%8.1f   %5.3f   %+.2f\n", tadpole.time(), senses.target_distance, senses.target->z());
        tadpole.drive(controller(tadpole.model().actuators, tadpole.time() + tadpole.scene().time_step, senses));
        if (!tadpole.step()) throw std::runtime_error("unstable in stage " + tadpole.instability()->stage);
    }
    std::printf("swam %.3f units, work %.0f\n", tadpole.distance(), tadpole.muscle_work());
    return 0;
} catch (const std::exception& error) {  // a scene that is not there, values that do not fit it ...
    std::fprintf(stderr, "driven: %s\n", error.what());
    return 1;
}
