#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "water/water_case.h"

/// The cases of `bench water` as tests run them.
namespace natator::test {

inline std::vector<bench::WaterFigure> water_figures(const std::string& water_case, const bench::Setting& solver,
                                                     int resolution, int start = 1) {
    bench::WaterSetting setting;
    setting.solver = solver;
    setting.resolution = resolution;
    setting.start = start;
    for (const bench::WaterCase& one : bench::water_cases())
        if (one.name == water_case) return one.run(setting).figures;
    throw std::logic_error("no such case: " + water_case);
}

}  // namespace natator::test
