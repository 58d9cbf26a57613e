#pragma once

#include <CLI/CLI.hpp>
#include <string>

/// The subcommands of natator-sim, one file each. A command that fails throws; `main` turns exceptions into one line on
/// standard error and an exit code.
namespace natator::cli {

/// Exit codes, documented for users.
enum Exit { ok = 0, failure = 1, bad_input = 2, unstable = 3, no_device = 4 };

/// Each adds a subcommand to `app`. When it runs it sets `status`.
void add_evaluate(CLI::App& app, int& status);
void add_serve(CLI::App& app, int& status);
void add_run(CLI::App& app, int& status);
void add_stream(CLI::App& app, int& status);
void add_info(CLI::App& app, int& status);
void add_particles(CLI::App& app, int& status);
void add_bench(CLI::App& app, int& status);

/// Writes text to standard output at once. Throws std::runtime_error when that fails (closed pipe, full disk).
void print(const std::string& text);

}  // namespace natator::cli
