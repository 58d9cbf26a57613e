#pragma once

#include <CLI/CLI.hpp>

#include "program.h"

/// The subcommands of natator-sim and natator-bench, one file each. A command that fails throws; `main` turns
/// exceptions into one line on standard error and an exit code.
namespace natator::cli {

/// Each adds a subcommand to `app`. When it runs it sets `status`.
void add_evaluate(CLI::App& app, int& status);
void add_converge(CLI::App& app, int& status);
void add_serve(CLI::App& app, int& status);
void add_run(CLI::App& app, int& status);
void add_stream(CLI::App& app, int& status);
void add_info(CLI::App& app, int& status);
void add_particles(CLI::App& app, int& status);

/// Likewise a study of natator-bench each, in studies/.
void add_precision(CLI::App& app, int& status);
void add_ensemble(CLI::App& app, int& status);
void add_roofline(CLI::App& app, int& status);
void add_speed(CLI::App& app, int& status);
void add_stability(CLI::App& app, int& status);
void add_stages(CLI::App& app, int& status);
void add_swimmers(CLI::App& app, int& status);
void add_throughput(CLI::App& app, int& status);
void add_validation(CLI::App& app, int& status);
void add_water(CLI::App& app, int& status);

/// Becomes natator-bench, the program beside this one, with the same arguments. Returns only by an exception, when that
/// program is not there.
[[noreturn]] void start_bench(char** arguments);

}  // namespace natator::cli
