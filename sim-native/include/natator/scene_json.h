#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "natator/scene.h"

namespace natator {

/// Reads and validates a scene. `name` is a named scene (`thesis/creature-1`) or the path of a file ending in `.json`,
/// relative to the working directory. Keys that are absent take the defaults of scene.h and parameters.h.
/// Throws InputError naming the scene, the field's path, its value and what is allowed.
Scene load_scene(const std::string& name);

/// The same after applying `overrides`, a JSON merge patch (RFC 7386), to the scene.
Scene load_scene(const std::string& name, const nlohmann::json& overrides);

/// What `load_scene` validates: the scene with its bases, the overrides and its creature's file merged into one JSON
/// object. All that a simulation of it depends on, besides the request and the program. Throws InputError.
nlohmann::json scene_definition(const std::string& name, const nlohmann::json& overrides);

/// Validates a scene given as JSON; `name` is used in messages. A `base` is not resolved here.
Scene scene_from_json(const nlohmann::json& document, const std::string& name);

/// Names of all scenes in the data directories, sorted.
std::vector<std::string> scene_names();

}  // namespace natator
