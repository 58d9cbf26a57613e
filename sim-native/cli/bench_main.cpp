#include "commands.h"
#include "natator/version.h"

int main(int argc, char** argv) {
    using namespace natator::cli;
    CLI::App app("Runs a study of the solver and writes its results as CSV.", "natator-bench");
    app.set_version_flag("--version", "natator-bench " NATATOR_VERSION);
    app.footer("Exit codes: 0 ok, 1 failure, 2 bad usage or input, 4 no such device.");
    int status = ok;
    add_studies(app, status);
    return run_program(app, status, argc, argv);
}
