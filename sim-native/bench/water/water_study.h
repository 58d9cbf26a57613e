#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "result_table.h"
#include "water/water_case.h"

namespace natator::bench {

/// Cases of water under several settings.
struct WaterStudy {
    std::vector<std::string> cases;  ///< names of water_cases()
    std::vector<int> resolutions;    ///< particles along the case's length
    std::vector<Setting> settings;
    /// see WaterSetting; scheme flex has none and runs once
    std::vector<double> supports{SolverParameters().conserving.kernel_support};
    std::vector<int> starts{1};  ///< likewise
    std::optional<int> gpu{};    ///< its number; none: on the CPU
    bool held = true;            ///< also the cases of bodies that are held
};

/// Columns case, resolution, scheme, precision, backend, substeps, iterations, modified_pressure (yes, no), support,
/// start (these three empty in scheme flex), quantity (these are the key); status (ok, unstable, too viscous: for an
/// explicit substep of that length); value; reference; least, greatest (the target; empty: no limit); met (yes, no);
/// particles; run_time (s).
Row water_columns();
inline constexpr std::size_t water_key_columns = 11;

/// Columns case, resolution, scheme, precision, backend, substeps, iterations, modified_pressure, support, time (s;
/// these are the key), value.
Row water_curve_columns();
inline constexpr std::size_t water_curve_key_columns = 10;

/// Runs what `table` does not hold yet, but for cases of held bodies where these do not run; the curves of the first
/// start go into `curves`. `report` gets a line per row.
void run_water_study(const WaterStudy& study, ResultTable& table, ResultTable& curves,
                     const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
