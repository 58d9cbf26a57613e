#pragma once

#include <optional>
#include <string>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// How a swimmer moves, in the numbers of fluid mechanics. U = |change of mean x| / simulated time, L = the body's length,
/// f = the gait's frequency, A = peak-to-peak amplitude of the tail, nu = kinematic_viscosity.
struct SwimmingNumbers {
    double tail_amplitude = 0;              ///< A, length: mean over the last beats, three at most
    std::optional<double> strouhal;         ///< f A / U; none at rest
    std::optional<double> reynolds;         ///< U L / nu; none where nu is 0
    std::optional<double> swimming_number;  ///< 2 pi f A L / nu (Gazzola and others 2014); none where nu is 0
    double across = 0;                      ///< water_across of the body
    std::optional<double> cavities;         ///< at the end, in volumes of the body, see cavities(); none without gravity
};

/// How many spacings of the water, or cells, the body is across: the lesser of width and height of its thickest slice at rest. Below
/// `min_spacings_across` its speed may change by half and more with a finer water. 0 without a body or water.
double water_across(const Model& model);
inline constexpr double min_spacings_across = 4;
/// "the body is 1.5 spacings of the water across, of which it needs 4: ..." where it is below `min_spacings_across`; else empty.
std::string warning_of_across(double across);

/// Mean z of the body's last slice, length: across the swimmer's heading at the start. 0 without a body.
template <class Real>
double tail_z(const Body& body, const State<Real>& state);

/// Peak-to-peak amplitude of a periodic motion that may drift: in each of the last three periods, as far as there are so
/// many, the range of what is left once the line from its first to its last value is taken off; their mean. `path` has a
/// value every `time_step` (s). None if it is shorter than a period, or a period than eight steps.
std::optional<double> peak_to_peak(const std::vector<double>& path, double time_step, double period);

/// Volume of the water, in volumes of the body, that is held together no longer although it lies deep: with less than 0.9 of
/// rest density, below which the scheme gives water no pressure, and deeper below the surface than the kernel's support.
/// Water follows a body that moves at u only where its pressure exceeds some rho u^2 / 2; elsewhere it tears off, as there are
/// no negative pressures, and the swim is one for this depth and gravity alone. The surface is where 95 % of the water lie
/// below, as in a tank. `densities`: by particle, in units of rest density. None without a body or gravity.
template <class Real>
std::optional<double> cavities(const Model& model, const State<Real>& state, const std::vector<Real>& densities);

/// Dimensionless numbers of a run that got `distance` (length) in `simulated` (s), with its tail at `tail` (tail_z for
/// each frame, length, the start first). None unless a body with muscles swims in water of scheme `conserving` or `lattice`, or if
/// the tail did not beat once; see peak_to_peak.
std::optional<SwimmingNumbers> swimming_numbers(const Model& model, const Gait& gait, double distance, double simulated,
                                                const std::vector<double>& tail);

}  // namespace natator
