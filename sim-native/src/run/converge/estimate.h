#pragma once

#include <optional>
#include <vector>

namespace natator {

struct Spread {
    double mean = 0;
    double deviation = 0;  ///< of the sample, n - 1 in the denominator; 0 for a single value
};

/// Needs at least one value.
Spread spread(const std::vector<double>& values);

/// Mean of a figure over runs from several starts.
struct Sample {
    double mean = 0;
    double error = 0;  ///< standard error of the mean; infinite where it is not known
    int runs = 0;
};

/// Of as many values as there are; a single one does not tell its error.
Sample sample_of(const std::vector<double>& values);

/// to - from and its standard error.
Sample difference(const Sample& from, const Sample& to);

/// to / from - 1 and its standard error. None where `from` is not known to differ from 0: where it is within two
/// standard errors of it.
std::optional<Sample> relative_change(const Sample& from, const Sample& to);

/// A figure's way to its limit as a step h goes to 0: f(h) = f(0) + c h^p, from its values at h, h/2 and, perhaps, h/4.
struct Limit {
    double order = 1;        ///< p
    bool observed = false;   ///< whether p follows from three levels, or is assumed
    double from_base = 0;    ///< f(0) - f(h)
    double from_finest = 0;  ///< f(0) - f at the finest level
    double base_weight = 0, half_weight = 0, quarter_weight = 0;  ///< of the levels in from_base
};

/// p is log2 of the ratio of the two changes if both are larger than twice their standard errors and of one sign, and
/// if it comes out between 1/2 and 4; else 1, with the two finest levels (Richardson 1911).
Limit limit_of(const Sample& base, const Sample& half, const std::optional<Sample>& quarter);

/// A figure for time step and spacing 0, f + (f_t(0) - f) + (f_s(0) - f), as far as there are levels.
struct Estimate {
    double value = 0;
    double statistical = 0;     ///< standard error, by that of the levels; infinite where one of theirs is not known
    double discretisation = 0;  ///< how far the limits are from their finest levels, root of the sum of squares
    double error = 0;           ///< root of the sum of the squares of both
    std::optional<Limit> time, space;
};

/// `half_space` is at half the spacing; `with_step`: and at half the time step, so that it is compared with
/// `half_time`.
Estimate estimate_of(const Sample& base, const std::optional<Sample>& half_time,
                     const std::optional<Sample>& quarter_time, const std::optional<Sample>& half_space,
                     bool with_step = false);

}  // namespace natator
