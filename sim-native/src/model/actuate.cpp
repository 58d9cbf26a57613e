#include "natator/model.h"

#include "check_gait.h"
#include "check_model.h"
#include "physics/muscle.h"

namespace natator {

namespace {

/// Adds what drives the actuators of one swimmer.
void add_drive(const Gait& gait, double ramp, double time, std::vector<double>& driven) {
    for (std::size_t i = 0; i < gait.amplitude.size(); ++i) {
        const double offset = gait.offset.empty() ? 0 : ramp * gait.offset[i];
        driven.push_back(physics::muscle_drive(ramp * gait.amplitude[i], activation(gait, static_cast<int>(i), time),
                                               gait.offset.empty() ? nullptr : &offset));
    }
}

double ramp_at(const Model& model, double time) {
    return model.scheme != Scheme::flex ? physics::start_ramp(time) : 1.0;
}

}  // namespace

std::vector<double> drive(const Model& model, const Gait& gait, double time, int swimmer) {
    check_lengths(gait, model.actuators_of(swimmer));
    std::vector<double> driven;
    add_drive(gait, ramp_at(model, time), time, driven);
    return driven;
}

template <class Real>
void actuate(const Model& model, const Gait& gait, double time, State<Real>& state) {
    actuate(model, drive(model, gait, time), time, state);
}

template <class Real>
void actuate(const Model& model, std::vector<double> driven, double time, State<Real>& state) {
    check_driven(model, driven);
    if (!model.muscles.empty()) check_springs(model, state);
    if (driven.size() == static_cast<std::size_t>(model.actuators))
        for (const CompanionBody& companion : model.companions)
            add_drive(companion.gait, ramp_at(model, time), time, driven);
    for (const Muscle& muscle : model.muscles) {
        const double rest = model.springs[muscle.spring].rest_length;
        const double length = physics::muscle_length(rest, muscle.lateral, driven[muscle.actuator]);
        state.spring_rest_length[muscle.spring] = static_cast<Real>(length);
    }
}

template void actuate(const Model&, const Gait&, double, State<float>&);
template void actuate(const Model&, const Gait&, double, State<double>&);
template void actuate(const Model&, std::vector<double>, double, State<float>&);
template void actuate(const Model&, std::vector<double>, double, State<double>&);

}  // namespace natator
