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

/// A number as it is shown in messages: the shortest text that reads back as it.
std::string number_text(double value);

/// The same of one that was computed: to 12 digits, without the rounding of its computation.
std::string computed_text(double value);

/// The same of one that means little beyond three digits, such as a figure of a chaotic swim; without the sign of zero.
std::string figure_text(double value);

/// A value as it is shown in messages: on one line, shortened to about 60 characters; of no JSON, NaN and Infinity too.
std::string shown(const nlohmann::json& value);

/// Text in quotes as it is shown in messages: on one line, shortened to about 400 bytes. Control characters and bytes that
/// are no UTF-8 are escaped as in JSON (of shown values too), other characters stand as they are.
std::string quoted(const std::string& text);

/// A message as it is printed: ends of lines are spaces, the same characters are escaped as in quoted text, nothing is
/// shortened.
std::string as_one_line(const std::string& text);

}  // namespace natator
