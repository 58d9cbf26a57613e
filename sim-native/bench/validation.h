#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dam_break.h"
#include "result_table.h"

namespace natator::bench {

/// A column whose collapse is compared with Martin and Moyce's (1952).
struct DamBreakCase {
    std::string name;
    int height_over_base;  ///< n^2
    bool ideal;            ///< see DamBreak
};

/// "tall" (n^2 = 2), "square" (n^2 = 1), "tall-thesis" (with the thesis' viscosity, damping and friction).
const std::vector<DamBreakCase>& dam_break_cases();

/// Checks against what others measured: the front of a collapsing column against the experiment, and the density of
/// the fluid at rest in the thesis' tank against other simulators.
struct ValidationStudy {
    std::vector<std::string> dam_breaks;      ///< names of dam_break_cases()
    int width = 24;                           ///< particles along the base of the column
    double last_time = 3.5;                   ///< of the front, T = t sqrt(n^2 g / a)
    std::vector<Setting> dam_break_settings;  ///< how the columns are computed
    std::vector<Setting> tank_settings;       ///< how the tank is computed
    double rest = 1;                          ///< of the tank before its density is measured, s
    double window = 0.5;                      ///< over which its density is averaged, s
};

/// Columns part (dam-break, tank), case, width, scheme, precision, substeps, iterations (these are the key); status
/// (ok, unstable, published); particles; run_time (s; of the collapse, or of 4 s of the tank by the median frame);
/// particle_iterations (millions/s); start_height (over the base), front_error, arrival_error, lag,
/// front_error_after_lag (see FrontError); density_error_mean, density_error_max, density_deviation (see
/// SettledTankRun). The rows of other simulators have their name as scheme.
Row validation_columns();
inline constexpr std::size_t validation_key_columns = 7;

/// Columns case, width, scheme, precision, substeps, iterations, time (T; these are the key), position (Z). The rows of
/// the measured front have the scheme "experiment".
Row front_columns();
inline constexpr std::size_t front_key_columns = 7;

/// Runs what `table` does not hold yet; the fronts' paths go into `fronts`. `report` gets a line per row.
void run_validation_study(const ValidationStudy& study, ResultTable& table, ResultTable& fronts,
                          const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
