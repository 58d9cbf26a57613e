#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "natator/scene.h"

namespace natator {

/// The folder in which named scenes and creatures are looked up: $NATATOR_DATA if it is not empty, else
/// `../share/natator` beside the folder of the running program. It is not said that it exists.
std::filesystem::path data_directory();

/// Where a scene is looked up, and what is changed in it.
struct SceneOptions {
    std::string overrides{};       ///< JSON merge patch (RFC 7386) on the scene, as text; empty changes nothing
    std::filesystem::path data{};  ///< folder that holds scenes/ and creatures/; empty: data_directory()
};

/// Reads and validates a scene. `name` is a named scene (`thesis/creature-1`) or the path of a file ending in `.json`,
/// relative to the working directory. Keys that are absent take the values of thesis_tank(), except planes and fluid,
/// of which there are none. Throws InputError naming the scene, the field's path, its value and what is allowed.
Scene load_scene(const std::string& name, const SceneOptions& options = {});

/// Validates a scene given as JSON text; `name` is used in messages. A `base` is not resolved here. Throws InputError.
Scene parse_scene(const std::string& text, const std::string& name);

/// Names of all scenes in a data directory, sorted; `data` as in SceneOptions.
std::vector<std::string> scene_names(const std::filesystem::path& data = {});

}  // namespace natator
