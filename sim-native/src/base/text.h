#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

/// Numbers and text as messages show them, and as they are read.
namespace natator {

/// The number that a text is as a whole: finite, in decimal digits with or without an exponent; none if it is anything
/// else, such as 0x2, 1f, NaN, or a number with spaces.
std::optional<double> decimal_number(std::string_view text);

/// A number as it is shown in messages: the shortest text that reads back as it.
std::string number_text(double value);
std::string number_text(float value);  ///< likewise

/// The same of one that was computed: to 12 digits, without the rounding of its computation.
std::string computed_text(double value);

/// The same of one that means little beyond three digits, such as a figure of a chaotic swim; without the sign of zero.
std::string figure_text(double value);

/// A value as it is shown in messages: on one line, shortened to about 60 characters; of no JSON, NaN and Infinity too.
std::string shown(const nlohmann::json& value);

/// Text in quotes as it is shown in messages: on one line, shortened to about 400 bytes. Control characters and bytes
/// that are no UTF-8 are escaped as in JSON (of shown values too), other characters stand as they are.
std::string quoted(const std::string& text);

/// A message as it is printed: ends of lines are spaces, the same characters are escaped as in quoted text, nothing is
/// shortened.
std::string as_one_line(const std::string& text);

/// Cuts text to `max_length` bytes, and not in the middle of a UTF-8 character.
std::string shortened(std::string text, std::size_t max_length);

}  // namespace natator
