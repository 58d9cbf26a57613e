#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace natator {

/// Reads a data file of one kind ("scenes", "creatures", "references") by name, or by path if the name ends in `.json`.
///
/// Names are looked up in the directory that the environment variable NATATOR_DATA names; without it in
/// `<directory of the executable>/../share/natator`, then in the source tree this was built from.
/// Throws InputError when there is no such file, naming those there are.
nlohmann::json read_data_file(const std::string& kind, const std::string& name);

/// All names of one kind, sorted.
std::vector<std::string> data_file_names(const std::string& kind);

}  // namespace natator
