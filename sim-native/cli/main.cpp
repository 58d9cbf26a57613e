#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>

#include "commands.h"
#include "commit.h"
#include "natator/error.h"
#include "natator/instruction_set.h"

namespace natator::cli {
namespace {

/// Says on one line of standard error what went wrong.
int complain(int status, std::string message) {
    for (char& c : message) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    std::cerr << "natator-sim: " << message << '\n';
    return status;
}

int run_command(int argc, char** argv) {
    CLI::App app("Simulates soft swimmers in a tank of fluid.", "natator-sim");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("natator-sim " NATATOR_VERSION ", commit ") + commit() +
                                          ", instruction set " + to_string(instruction_set()));
    app.footer(
        "Exit codes: 0 ok, 1 failure, 2 bad usage or input, 3 unstable simulation, 4 no such device.\n"
        "Scenes are names (see `natator-sim info`) or paths ending in .json.");
    int status = ok;
    add_evaluate(app, status);
    add_serve(app, status);
    add_run(app, status);
    add_stream(app, status);
    add_info(app, status);
    add_particles(app, status);
    add_bench(app, status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        std::ostringstream text;
        app.exit(help_or_version, text, text);
        print(text.str());
    } catch (const CLI::ParseError& error) {
        return complain(bad_input, std::string(error.what()) + "; see natator-sim --help");
    }
    return status;
}

}  // namespace

void print(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw std::runtime_error("standard output cannot be written");
    }
}

}  // namespace natator::cli

int main(int argc, char** argv) {
    using namespace natator::cli;
    std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of print, not a death
    try {
        return run_command(argc, argv);
    } catch (const natator::InputError& error) {
        return complain(bad_input, error.what());
    } catch (const natator::NoDevice& error) {
        return complain(no_device, error.what());
    } catch (const std::bad_alloc&) {
        return complain(failure, "out of memory");
    } catch (const std::exception& error) {
        return complain(failure, error.what());
    }
}
