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

    Eigen::Vector3i count;           ///< particles of the box
    Eigen::Vector3d middle;          ///< of the body
    double diameter = 1;             ///< as asked for; its particles make it a little more or less
    bool cylinder = false;           ///< across the whole box along z; else a sphere
    double speed = 1;                ///< after a diameter in which it grows evenly
    double gravity = 1;              ///< enough for the water to close behind the body
    std::vector<Leg> legs;
};

struct TowSample {
    double time = 0;  ///< s
    double way = 0;   ///< of this leg, diameters
    double drag = 0;  ///< coefficients: force / (density speed^2 / 2 x area across the flow)
    double lift = 0;  ///< along y, without buoyancy
};

struct TowResult {
    WaterRun run;           ///< without figures
    double diameter = 0;    ///< of a sphere or circle of the volume that the body's particles have
    std::vector<std::vector<TowSample>> legs;  ///< a sample a frame
};

TowResult tow(const Towing& towing, const WaterSetting& setting);

/// Mean of one of the coefficients over the part of a leg that begins after so many diameters.
double mean(const std::vector<TowSample>& leg, double TowSample::* coefficient, double begin);

/// Means over every quarter of a diameter of one of the coefficients, for a curve: the frames themselves are noisy.
std::vector<WaterSample> smoothed(const TowResult& result, double TowSample::* coefficient);

}  // namespace natator::bench
