#include "water/water_case.h"

namespace natator::bench {

namespace {

std::vector<WaterCase> all_cases() {
    const std::vector<std::string> of_vortex{"amplitude after one turnover", "numerical Reynolds number",
                                             "gain of kinetic energy", "gain of kinetic and potential energy"};
    const std::vector<std::string> of_channel{"viscosity (length^2/s)", "drag of the walls (of the exact)",
                                              "slip length (particle distances)"};
    return {
        {"vortex", "amplitude", of_vortex, run_vortex},
        {"stirred-vortex", "amplitude", of_vortex, run_stirred_vortex},
        {"viscous-vortex", "amplitude", {"viscosity (length^2/s)"}, run_viscous_vortex},
        {"standing-wave", "elevation of the mode (length)", {"period (s)", "decay (1/s)"}, run_standing_wave},
        {"tilted-gravity",
         "slope of the surface (degrees)",
         {"slope under 1 degree (degrees)", "slope afterwards (degrees)"},
         run_tilted_gravity},
        {"still-water", "depth (length)", {"bobbing (length/s)"}, run_still_water},
        {"neutral-sphere", "depth fallen (length)", {"error of buoyancy (of the weight)"}, run_neutral_sphere},
        {"added-mass", "speed of the fall (length/s)", {"added mass (of the displaced)"}, run_added_mass},
        {"heavier-sphere", "depth fallen (length)", {"terminal speed (length/s)"}, run_heavier_sphere, true},
        {"lighter-sphere", "depth fallen (length)", {"terminal speed (length/s)"}, run_lighter_sphere, true},
        {"column",
         "pressure (of the hydrostatic)",
         {"pressure (of the hydrostatic)", "depth (length)", "speed at rest (length/s)"},
         run_column,
         true},
        {"couette", "drag of the walls (of the exact)", of_channel, run_couette, true},
        {"poiseuille", "drag of the walls (of the exact)", of_channel, run_poiseuille, true},
        {"spinning-sphere", "torque (of Kirchhoff's)", {"torque (of Kirchhoff's)"}, run_spinning_sphere, true},
        {"slow-sphere", "torque (of Kirchhoff's)", {"torque (of Kirchhoff's)"}, run_slow_sphere, true},
        {"towed-sphere",
         "drag coefficient",
         {"drag coefficient at Re 100", "drag coefficient at Re 50", "drag coefficient at Re 20",
          "drag coefficient at Re 10"},
         run_towed_sphere,
         true},
        {"towed-cylinder",
         "drag coefficient",
         {"drag coefficient at Re 40", "drag coefficient at Re 20"},
         run_towed_cylinder,
         true},
        {"shedding-cylinder",
         "lift coefficient",
         {"drag coefficient at Re 100", "Strouhal number at Re 100"},
         run_shedding_cylinder,
         true},
        {"tall-cylinder",
         "lift coefficient",
         {"drag coefficient at Re 100", "Strouhal number at Re 100"},
         run_tall_cylinder,
         true},
        {"travelling-wave",
         "speed (lengths/s)",
         {"Strouhal number at viscosity 0.003", "Reynolds number at viscosity 0.003",
          "tail beat at viscosity 0.003 (lengths)", "Strouhal number at viscosity 0.006",
          "Reynolds number at viscosity 0.006", "tail beat at viscosity 0.006 (lengths)",
          "Strouhal number at viscosity 0.01", "Reynolds number at viscosity 0.01",
          "tail beat at viscosity 0.01 (lengths)", "drift to the side (lengths)"},
         run_travelling_wave,
         true},
    };
}

}  // namespace

const std::vector<WaterCase>& water_cases() {
    static const std::vector<WaterCase> cases = all_cases();
    return cases;
}

}  // namespace natator::bench
