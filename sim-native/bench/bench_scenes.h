#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"
#include "natator/scene.h"

namespace natator::bench {

/// A scene as the studies run it: particles, muscles' drive, and how it comes to rest before time 0.
struct Subject {
    std::string name;
    Model model;
    Gait gait;
    Settling settling;
    bool isolated = false;  ///< no force from outside acts, so momentum stays as it is
};

/// Names of the scenes, in the order in which studies run them.
std::vector<std::string> subject_names();

/// Throws InputError for an unknown name.
Subject make_subject(const std::string& name);

/// How many of its particles are fluid.
int fluid_particles(const Model& model);

/// What makes another tank of the thesis': a block of so many particles of such a spacing, and the walls behind it.
nlohmann::json thesis_tank_with(const std::array<int, 3>& count, double spacing);

/// Best gaits of creatures 1 and 2 that the thesis found. Throws InputError for another creature.
Gait thesis_gait(int creature);

}  // namespace natator::bench
