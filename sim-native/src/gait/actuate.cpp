#include "natator/actuate.h"

#include <cmath>

namespace natator {
namespace {

/// Largest relative change of a muscle's length at amplitude 1 (thesis 2.8).
constexpr double epsilon = 0.5;

}  // namespace

template <class Real>
void actuate(const Model& model, const Gait& gait, double time, State<Real>& state) {
    std::vector<double> drive(static_cast<std::size_t>(model.actuators));  // a u per actuator
    for (int i = 0; i < model.actuators; ++i) drive[i] = gait.amplitude[i] * activation(gait, i, time);

    for (const Muscle& muscle : model.muscles) {
        const double rest = model.springs[muscle.spring].rest_length;
        const double length = rest * (1 + epsilon * muscle.lateral * drive[muscle.actuator]);
        state.spring_rest_length[muscle.spring] = static_cast<Real>(length);
    }
}

template void actuate(const Model&, const Gait&, double, State<float>&);
template void actuate(const Model&, const Gait&, double, State<double>&);

}  // namespace natator
