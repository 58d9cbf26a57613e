#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace natator {

/// Parses JSON text. Refuses what the format's usual readers let pass in silence: a key given twice, and nesting deeper
/// than 32. Throws InputError with one line: `source`, line and column, what was wrong.
nlohmann::json parse_json(const std::string& text, const std::string& source);

/// Reads a stream to its end. Throws InputError when it cannot be read or holds more than 16 MiB.
std::string read_all(std::FILE* file, const std::string& source);

/// Reads a JSON file. Throws InputError when it is absent, unreadable, too large (over 16 MiB) or not valid.
nlohmann::json read_json_file(const std::string& path);

}  // namespace natator
