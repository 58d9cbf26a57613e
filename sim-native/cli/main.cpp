#include <string_view>

#include "commands.h"
#include "commit.h"
#include "natator/instruction_set.h"
#include "natator/version.h"

int main(int argc, char** argv) {
    using namespace natator::cli;
    if (argc > 1 && std::string_view(argv[1]) == "bench")
        return report_errors("natator-sim", [argv]() -> int { start_bench(argv + 1); });
    CLI::App app("Simulates soft swimmers in a tank of fluid.", "natator-sim");
    app.set_version_flag("--version", [] {
        return std::string("natator-sim " NATATOR_VERSION ", commit ") + commit() + ", instruction set " +
               to_string(natator::instruction_set());
    });
    app.footer(
        "Exit codes: 0 ok, 1 failure, 2 bad usage or input, 3 unstable simulation, 4 no such device.\n"
        "Scenes are names (see `natator-sim info`) or paths ending in .json.");
    int status = ok;
    add_evaluate(app, status);
    add_converge(app, status);
    add_serve(app, status);
    add_run(app, status);
    add_stream(app, status);
    add_info(app, status);
    add_particles(app, status);
    app.add_subcommand("bench", "Measure speed and accuracy: starts natator-bench; see natator-sim bench --help.");
    return run_program(app, status, argc, argv);
}
