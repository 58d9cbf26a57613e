#pragma once

#include <vector>

namespace natator::bench {

/// A point of the path of a surge front, in the units of Martin and Moyce (1952).
struct FrontPoint {
    double time = 0;      ///< T = t sqrt(n^2 g / a)
    double position = 0;  ///< Z = x / a
};
using FrontCurve = std::vector<FrontPoint>;  ///< times and positions grow

/// Linear between the points; the end points' values beyond them. Needs at least one point.
double position_at(const FrontCurve& curve, double time);
double time_at(const FrontCurve& curve, double position);

/// How a computed front differs from a measured one.
struct FrontError {
    double position = 0;            ///< root mean square of the difference of Z at the measured T
    double arrival = 0;             ///< mean of |T / T_measured - 1| at the measured Z
    double lag = 0;                 ///< mean of T_measured - T at the measured Z: a gate takes time to open
    double position_after_lag = 0;  ///< root mean square of the difference of Z once the computed front waits that long
};

/// Over the measured points that the computed front reached. Both curves need at least one point.
FrontError front_error(const FrontCurve& computed, const FrontCurve& measured);

}  // namespace natator::bench
