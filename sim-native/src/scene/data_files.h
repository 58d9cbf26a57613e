#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "natator/load_scene.h"

namespace natator {

/// Reads a data file of one kind ("scenes", "creatures", "references") by name, or by path if the name ends in `.json`.
///
/// Names are looked up in `data`; if that is empty, in data_directory(). Throws InputError when there is no such file,
/// naming those there are.
nlohmann::json read_data_file(const std::string& kind, const std::string& name, const std::filesystem::path& data = {});

/// Where a mesh's file is: beside the creatures if it is a plain name and there, else at this path.
std::filesystem::path mesh_path(const std::string& file, const std::filesystem::path& data = {});

/// All names of one kind, sorted.
std::vector<std::string> data_file_names(const std::string& kind, const std::filesystem::path& data = {});

}  // namespace natator
