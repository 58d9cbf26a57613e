#pragma once

#include <optional>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// How a swimmer moves, in the numbers of fluid mechanics. U = |change of mean x| / simulated time, L = the body's length,
/// f = the gait's frequency, A = peak-to-peak amplitude of the tail, nu = kinematicViscosity.
struct SwimmingNumbers {
    double tail_amplitude = 0;              ///< A, length: mean over the last beats, three at most
    std::optional<double> strouhal;         ///< f A / U; none at rest
    std::optional<double> reynolds;         ///< U L / nu; none where nu is 0
    std::optional<double> swimming_number;  ///< 2 pi f A L / nu (Gazzola, Argentina, Mahadevan 2014); likewise
};

/// Mean z of the body's last slice, length: across the swimmer's heading at the start. 0 without a body.
template <class Real>
double tail_z(const Body& body, const State<Real>& state);

/// Peak-to-peak amplitude of a periodic motion that may drift: in each of the last three periods, as far as there are so
/// many, the range of what is left once the line from its first to its last value is taken off; their mean. `path` has a
/// value every `time_step` (s). None if it is shorter than a period, or a period than eight steps.
std::optional<double> peak_to_peak(const std::vector<double>& path, double time_step, double period);

/// Of a run whose tail went along `tail` (tail_z for each frame, the start first). None unless a body with muscles swims
/// in water that has a kinematicViscosity (scheme `conserving`), or if it did not beat once; see peak_to_peak.
std::optional<SwimmingNumbers> swimming_numbers(const Model& model, const Gait& gait, double distance, double simulated,
                                                const std::vector<double>& tail);

}  // namespace natator
