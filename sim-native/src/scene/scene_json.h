#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "natator/load_scene.h"

/// What natator/load_scene.h does, of parsed JSON. `data` as in SceneOptions.
namespace natator {

/// Reads a scene and applies `overrides`, a JSON merge patch (RFC 7386).
Scene load_scene(const std::string& name, const nlohmann::json& overrides, const std::filesystem::path& data = {});

/// What `load_scene` validates: the scene with its bases, the overrides and its creature's file merged into one JSON
/// object. All that a simulation of it depends on, besides the request and the program. Throws InputError.
nlohmann::json scene_definition(const std::string& name, const nlohmann::json& overrides,
                                const std::filesystem::path& data = {});

/// Validates a scene given as JSON; `name` is used in messages. A `base` is not resolved here.
Scene scene_from_json(const nlohmann::json& document, const std::string& name, const std::filesystem::path& data = {});

}  // namespace natator
