#include "water/water_case.h"

namespace natator::bench {

const std::vector<WaterCase>& water_cases() {
    static const std::vector<WaterCase> cases{
        {"vortex",
         "amplitude",
         {"amplitude after one turnover", "numerical Reynolds number", "gain of kinetic energy"},
         run_vortex},
        {"viscous-vortex", "amplitude", {"viscosity (length^2/s)"}, run_viscous_vortex},
        {"standing-wave", "elevation of the mode (length)", {"period (s)", "decay (1/s)"}, run_standing_wave},
        {"tilted-gravity",
         "slope of the surface (degrees)",
         {"slope under 1 degree (degrees)", "slope afterwards (degrees)"},
         run_tilted_gravity},
        {"neutral-sphere", "depth fallen (length)", {"error of buoyancy (of the weight)"}, run_neutral_sphere},
        {"added-mass", "depth fallen (length)", {"added mass (of the displaced)"}, run_added_mass},
        {"falling-sphere", "depth fallen (length)", {"drag coefficient", "Reynolds number"}, run_falling_sphere},
    };
    return cases;
}

}  // namespace natator::bench
