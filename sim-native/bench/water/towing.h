#pragma once

#include <functional>
#include <vector>

#include "water/water_case.h"

namespace natator::bench {

/// A body that is held in a box of water and towed along x, past more water than the box holds: see WaterTank::shift.
struct Towing {
    /// A part of the way.
    struct Leg {
        double reynolds;
        double way;  ///< diameters
    };

    Eigen::Vector3i count;   ///< particles of the box
    Eigen::Vector3d middle;  ///< of the body
    double diameter = 1;     ///< as asked for; its particles make it a little more or less
    bool cylinder = false;   ///< across the whole box along z; else a sphere
    double speed = 1;        ///< after a diameter in which it grows evenly
    double gravity = 1;      ///< enough for the water to close behind the body
    std::vector<Leg> legs;
    /// of the speed: once to and fro across the way, along y, in the first ten diameters: sets off vortices
    double sway = 0;
};

struct TowSample {
    double time = 0;  ///< s
    double way = 0;   ///< of this leg, diameters
    double drag = 0;  ///< coefficients: force / (density speed^2 / 2 x area across the flow)
    double lift = 0;  ///< along y, without buoyancy
};

struct TowResult {
    WaterRun run;         ///< without figures
    double diameter = 0;  ///< of a sphere or circle of the volume that the body's particles have
    double box_step = 0;  ///< diameters that the box is moved on by at a time; each gives the body a knock
    /// a sample a frame; without those whose viscosity is more than a substep bears
    std::vector<std::vector<TowSample>> legs;
};

TowResult tow(const Towing& towing, const WaterSetting& setting);

/// Mean of one of the coefficients over the part of a leg that begins after so many diameters.
double mean(const std::vector<TowSample>& leg, double TowSample::* coefficient, double begin);

/// Means over every quarter of a diameter of one of the coefficients, for a curve: the frames themselves are noisy.
std::vector<WaterSample> smoothed(const TowResult& result, double TowSample::* coefficient);

/// The lift of the last leg, frame by frame, without the knocks and what swings nearly as often as these: mean over
/// the last box step, taken three times.
std::vector<WaterSample> calm_lift(const TowResult& result);
/// Of the swings of that about its mean after so many diameters, 1/s: from the first to the last time that it passes it
/// upwards; 0 without any.
double lift_frequency(const TowResult& result, double begin);

}  // namespace natator::bench
