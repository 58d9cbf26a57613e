#pragma once

#include <CLI/CLI.hpp>

namespace natator::cli {

/// Makes an empty value of any option of any command refused: most come from a variable of a shell that is not set.
void refuse_empty_values(CLI::App& app);

/// Refuses `--option=`, for which the next argument would be taken.
void refuse_empty_values(int argc, const char* const* argv);

/// What a number of seconds may be: finite, and from 0.
CLI::Validator seconds();

}  // namespace natator::cli
