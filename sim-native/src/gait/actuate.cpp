#include "natator/actuate.h"

#include <algorithm>
#include <cmath>

namespace natator {
namespace {

/// Largest relative change of a muscle's length at amplitude 1 (thesis 2.8).
constexpr double epsilon = 0.5;

/// Scheme `conserving` starts its muscles softly: 0 to 1 over the first quarter of a second, with no kink (smoothstep).
double start_ramp(double time) {
    const double s = std::clamp(time / 0.25, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

}  // namespace

std::vector<double> drive(const Model& model, const Gait& gait, double time) {
    std::vector<double> driven(static_cast<std::size_t>(model.actuators));
    const double ramp = model.scheme == Scheme::conserving ? start_ramp(time) : 1.0;
    for (int i = 0; i < model.actuators; ++i) driven[i] = ramp * gait.amplitude[i] * activation(gait, i, time);
    return driven;
}

template <class Real>
void actuate(const Model& model, const Gait& gait, double time, State<Real>& state) {
    const std::vector<double> driven = drive(model, gait, time);
    for (const Muscle& muscle : model.muscles) {
        const double rest = model.springs[muscle.spring].rest_length;
        const double length = rest * (1 + epsilon * muscle.lateral * driven[muscle.actuator]);
        state.spring_rest_length[muscle.spring] = static_cast<Real>(length);
    }
}

template void actuate(const Model&, const Gait&, double, State<float>&);
template void actuate(const Model&, const Gait&, double, State<double>&);

}  // namespace natator
