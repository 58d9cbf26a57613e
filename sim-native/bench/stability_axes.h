#pragma once

#include <functional>
#include <string>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"
#include "natator/scene.h"

namespace natator::bench {

/// One simulation that a stability sweep puts under stress.
struct StabilityCase {
    Scene scene;
    Gait gait;
    std::function<void(Model&)> rearrange;  ///< moves particles before the start; may be empty
    /// Share of the run after which laws are looked at: above 0 where the start breaks one on purpose.
    double judged_from = 0;
};

/// A scene to put under stress.
struct StabilityScene {
    std::string name;
    std::string meaning;
    const char* overrides;         ///< JSON over scenes/bench/small-tank.json
    bool conserving_only = false;  ///< scheme `flex` does not have it
};

/// The first is the small tank alone.
const std::vector<StabilityScene>& stability_scenes();
/// Throws InputError for an unknown name.
const StabilityScene& stability_scene(const std::string& name);

/// The short swimmer in its small tank (scenes/bench/small-tank.json), or a change of it, at the thesis' settings, all
/// of it calm.
StabilityCase calm_case(const StabilityScene& scene = stability_scenes().front());

/// One direction in which a case is made harder.
struct StabilityAxis {
    std::string name;
    std::string meaning;               ///< of the value, with its unit
    std::vector<double> values;        ///< in the order in which they are run
    std::vector<double> quick_values;  ///< the ends of the range, for tests
    std::function<void(StabilityCase&, double)> set;
};

const std::vector<StabilityAxis>& stability_axes();

/// Two axes swept together, for the picture of the stable region.
struct StabilityMap {
    std::string first, second;
    std::vector<double> first_values, second_values;
};

const std::vector<StabilityMap>& stability_maps();

/// Throws InputError for an unknown name.
const StabilityAxis& stability_axis(const std::string& name);

}  // namespace natator::bench
