#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "natator/evaluate.h"

namespace natator::cli {

/// "a, b or c".
std::string any_of(const std::vector<std::string>& words);

/// Makes an empty value of any option of any command refused, most come from a variable of a shell that is not set, and
/// one that is the next option.
void refuse_missing_values(CLI::App& app);

/// Makes numbers in hexadecimal or octal digits refused, of any option of any command.
void refuse_other_bases(CLI::App& app);

/// Refuses `--option=`, for which the next argument would be taken.
void refuse_empty_values(int argc, const char* const* argv);

/// Makes a value that is given twice in a list refused, of any option of a command and of those below it.
void refuse_repeated_values(CLI::App& app);

// Checks of values. Their words, "= 7: must be ...", stand behind the option's name.

/// What a number of seconds may be: finite, and from 0.
CLI::Validator seconds();

/// A number of these limits; CLI::Range takes NaN for one.
CLI::Validator number_in(double low, double high);

/// A whole number of these limits.
CLI::Validator whole_number_in(int low, int high);

/// One of these words.
CLI::Validator one_of(const std::vector<std::string>& words);

/// A name of a precision, "float" or "double".
CLI::Validator precision_name();

/// The precision of such a name.
Precision precision_named(const std::string& name);

}  // namespace natator::cli
