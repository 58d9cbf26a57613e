#include "commands.h"
#include "natator/version.h"
#include "options.h"

int main(int argc, char** argv) {
    using namespace natator::cli;
    CLI::App app("Runs a study of the solver and writes its results as CSV.", "natator-bench");
    app.set_version_flag("--version", "natator-bench " NATATOR_VERSION);
    app.footer("Exit codes: 0 ok, 1 failure, 2 bad usage or input, 4 no such device.");
    int status = ok;
    add_precision(app, status);
    add_ensemble(app, status);
    add_roofline(app, status);
    add_speed(app, status);
    add_stability(app, status);
    add_stages(app, status);
    add_swimmers(app, status);
    add_throughput(app, status);
    add_validation(app, status);
    add_water(app, status);
    refuse_repeated_values(app);
    return run_program(app, status, argc, argv);
}
