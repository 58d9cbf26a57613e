#include "natator/actuate.h"

#include "physics/muscle.h"

namespace natator {

std::vector<double> drive(const Model& model, const Gait& gait, double time) {
    std::vector<double> driven(static_cast<std::size_t>(model.actuators));
    const double ramp = model.scheme != Scheme::flex ? physics::start_ramp(time) : 1.0;
    for (int i = 0; i < model.actuators; ++i) {
        driven[i] = gait.amplitude[i] * activation(gait, i, time);
        if (!gait.offset.empty()) driven[i] += gait.offset[i];
        driven[i] *= ramp;
    }
    return driven;
}

template <class Real>
void actuate(const Model& model, const Gait& gait, double time, State<Real>& state) {
    actuate(model, drive(model, gait, time), state);
}

template <class Real>
void actuate(const Model& model, const std::vector<double>& driven, State<Real>& state) {
    for (const Muscle& muscle : model.muscles) {
        const double rest = model.springs[muscle.spring].rest_length;
        const double length = physics::muscle_length(rest, muscle.lateral, driven[muscle.actuator]);
        state.spring_rest_length[muscle.spring] = static_cast<Real>(length);
    }
}

template void actuate(const Model&, const Gait&, double, State<float>&);
template void actuate(const Model&, const Gait&, double, State<double>&);
template void actuate(const Model&, const std::vector<double>&, State<float>&);
template void actuate(const Model&, const std::vector<double>&, State<double>&);

}  // namespace natator
