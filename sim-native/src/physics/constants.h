// Every number of the physics that is no parameter of a scene.
#pragma once

namespace natator::physics {

// Muscles and early stopping.
inline constexpr double muscle_strain = 0.5;     ///< epsilon, largest relative change of length at amplitude 1 (2.8)
inline constexpr double start_ramp_time = 0.25;  ///< s, over which muscles start, except in scheme `flex`
inline constexpr double measured_touch = 1e-6;   ///< of 1 + |plane offset|: rounding allowed where a touch is measured

// Shape matching.
inline constexpr int flex_fit_steps = 4;     ///< of the rotation fit, per iteration
inline constexpr double fit_epsilon = 1e-9;  ///< rotation that is not worth a further step, rad
inline constexpr int max_fit_steps = 20;     ///< except in scheme `flex`
/// the fit ends below this rotation, rad, except in scheme `flex`: a further step would be of its square
inline constexpr double fit_tolerance = 1e-6;
inline constexpr double min_fit_determinant = 1e-9;  ///< of the fit's matrix, of its trace cubed
inline constexpr double centre_dead_band = 1e-5;     ///< of scheme `flex`: less does not move a stored centre, length

// Pairs.
inline constexpr double min_square = 1e-30;       ///< added to r^2: 1/r stays finite, and no other r^2 changes
inline constexpr double far_away = 1e9;           ///< where the slot is that unused list entries point to
inline constexpr double min_response = 1e-30;     ///< below it a density constraint's neighbours are where W ends
inline constexpr double max_shock_exponent = 20;  ///< keeps the ratio of masses finite

// Limits.
inline constexpr double thesis_substep = 1.0 / 240;  ///< h0, s: what stiffness and cohesion are measured at
inline constexpr double overlap_tolerance = 0.1;     ///< of rest density or distance held: no overlap up to it
/// of a body in scheme `flex`, length: a thousand times centre_dead_band
inline constexpr double min_flex_spacing = 0.01;
/// of a body beside planes, length: below it measured_touch is further than a particle
inline constexpr double min_touch_spacing = 5e-7;
inline constexpr double touching_tolerance = 1e-4;  ///< of the radius: counts as touching a plane

}  // namespace natator::physics
