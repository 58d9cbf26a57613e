#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "natator/scene.h"
#include "path_run.h"

/// Cases of water whose outcome is known, for measuring how far a scheme is from being a fluid.
namespace natator::bench {

/// How a case is computed.
struct WaterSetting {
    Setting solver;
    int resolution = 20;                                            ///< particles along the case's length
    std::optional<int> gpu{};                                       ///< its number; none: on the CPU
    double support = SolverParameters().conserving.kernel_support;  ///< of the kernel of scheme conserving, in spacings
    int start = 1;  ///< of scheme conserving: each begins with its water disordered otherwise
};

/// One number that a case gives, beside what it should be.
struct WaterFigure {
    double value = 0;
    double reference = 0;                                       ///< exact
    double least = -std::numeric_limits<double>::infinity();    ///< the target: from here
    double greatest = std::numeric_limits<double>::infinity();  ///< to here

    bool is_met() const { return least <= value && value <= greatest; }
};

/// The target: within this part of what it should be.
inline WaterFigure figure_within(double part, double value, double reference) {
    return {
        .value = value, .reference = reference, .least = (1 - part) * reference, .greatest = (1 + part) * reference};
}

/// A point of the curve that a case follows.
struct WaterSample {
    double time = 0;  ///< s
    double value = 0;
};

struct WaterRun {
    int particles = 0;
    double seconds = 0;                ///< wall time of the frames
    std::vector<WaterFigure> figures;  ///< of the case's quantities: of the first ones where the others' viscosity is
                                       ///< more than a substep bears
    std::vector<WaterSample> curve;
    std::optional<Instability> instability;  ///< then figures mean nothing
};

struct WaterCase {
    std::string name;
    std::string curve;                    ///< what the curve shows
    std::vector<std::string> quantities;  ///< what the figures are
    std::function<WaterRun(const WaterSetting&)> run;
    bool held = false;  ///< takes minutes, and most of these need the forces on held bodies or the pressures: runs only
                        ///< where they are known, in scheme conserving
};

/// All cases.
const std::vector<WaterCase>& water_cases();

WaterRun run_vortex(const WaterSetting& setting);
WaterRun run_stirred_vortex(const WaterSetting& setting);
WaterRun run_viscous_vortex(const WaterSetting& setting);
WaterRun run_standing_wave(const WaterSetting& setting);
WaterRun run_tilted_gravity(const WaterSetting& setting);
WaterRun run_still_water(const WaterSetting& setting);
WaterRun run_neutral_sphere(const WaterSetting& setting);
WaterRun run_added_mass(const WaterSetting& setting);
WaterRun run_heavier_sphere(const WaterSetting& setting);
WaterRun run_lighter_sphere(const WaterSetting& setting);
WaterRun run_column(const WaterSetting& setting);
WaterRun run_couette(const WaterSetting& setting);
WaterRun run_poiseuille(const WaterSetting& setting);
WaterRun run_spinning_sphere(const WaterSetting& setting);
WaterRun run_slow_sphere(const WaterSetting& setting);
WaterRun run_towed_sphere(const WaterSetting& setting);
WaterRun run_towed_cylinder(const WaterSetting& setting);
WaterRun run_shedding_cylinder(const WaterSetting& setting);
WaterRun run_tall_cylinder(const WaterSetting& setting);
WaterRun run_travelling_wave(const WaterSetting& setting);

}  // namespace natator::bench
