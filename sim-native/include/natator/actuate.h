#pragma once

#include <functional>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// Throws InputError unless the gait has one amplitude and one phase per actuator and its values are within
/// frequency (0, 60] 1/s, amplitude [0, 2], phase [0, 1] turns, power [0.5, 4], and if there are offsets, one per actuator
/// with |offset| + amplitude at most 2.
void check_gait(const Gait& gait, int actuators);

/// What drives each actuator's muscles at `time` (s): o + a u, offset plus amplitude times activation, in scheme `conserving` times the
/// start ramp. The gait must fit the model (check_gait). Throws InputError if it has not one value for each actuator.
std::vector<double> drive(const Model& model, const Gait& gait, double time);

/// Sets the rest length of every muscle for `time` (s): l = l_rest (1 + 1/2 z_m (o + a u)), thesis (2.7) and (2.8).
/// The gait must fit the model (check_gait). The muscles of companions follow their own gaits. Throws InputError if there is not one
/// value for each actuator, or the state has not the model's number of springs.
template <class Real>
void actuate(const Model& model, const Gait& gait, double time, State<Real>& state);

/// Sets the rest length of every muscle for `time` (s) from `driven`, one value o + a u in [-2, 2] for each actuator of
/// the body, wherever it comes from. The muscles of companions follow their own gaits. Throws InputError if there is
/// not one value for each actuator, or the state has not the model's number of springs.
template <class Real>
void actuate(const Model& model, std::vector<double> driven, double time, State<Real>& state);

/// What drives each actuator's muscles at a time (s), as `drive` gives it for a gait.
using Drive = std::function<std::vector<double>(double time)>;

extern template void actuate(const Model&, const Gait&, double, State<float>&);
extern template void actuate(const Model&, const Gait&, double, State<double>&);
extern template void actuate(const Model&, std::vector<double>, double, State<float>&);
extern template void actuate(const Model&, std::vector<double>, double, State<double>&);

}  // namespace natator
