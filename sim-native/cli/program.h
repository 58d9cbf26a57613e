#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

/// What the programs have in common: exit codes, and one line on standard error for what went wrong.
namespace natator::cli {

/// Exit codes, documented for users.
enum Exit { ok = 0, failure = 1, bad_input = 2, unstable = 3, no_device = 4 };

/// Reads the arguments, runs the command that they name and returns its exit code, or that of what it threw.
int run_program(CLI::App& app, const int& status, int argc, char** argv);

/// Does `work` and returns its exit code; says on one line of standard error what it threw, and returns the code of
/// that.
int report_errors(const std::string& program, const std::function<int()>& work);

/// Writes text to standard output at once. Throws std::runtime_error when that fails (closed pipe, full disk).
void print(const std::string& text);

}  // namespace natator::cli
