#include "natator/actuate.h"

#include <string>

#include "natator/error.h"
#include "physics/muscle.h"

namespace natator {

namespace {

/// Adds what drives the actuators of one swimmer.
void add_drive(const Gait& gait, double ramp, double time, std::vector<double>& driven) {
    for (std::size_t i = 0; i < gait.amplitude.size(); ++i) {
        driven.push_back(ramp * gait.amplitude[i] * activation(gait, static_cast<int>(i), time));
        if (!gait.offset.empty()) driven.back() += ramp * gait.offset[i];
    }
}

void require_one_each(const Model& model, const char* name, std::size_t values) {
    if (values != static_cast<std::size_t>(model.actuators))
        throw InputError(std::string(name) + " has length " + std::to_string(values) + ": must have length " +
                         std::to_string(model.actuators) + ", one value per actuator of the creature");
}

double ramp_at(const Model& model, double time) {
    return model.scheme != Scheme::flex ? physics::start_ramp(time) : 1.0;
}

}  // namespace

std::vector<double> drive(const Model& model, const Gait& gait, double time) {
    require_one_each(model, "gait.amplitude", gait.amplitude.size());
    require_one_each(model, "gait.phase", gait.phase.size());
    if (!gait.offset.empty()) require_one_each(model, "gait.offset", gait.offset.size());
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
    require_one_each(model, "drive", driven.size());
    for (const CompanionBody& companion : model.companions) add_drive(companion.gait, ramp_at(model, time), time, driven);
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
