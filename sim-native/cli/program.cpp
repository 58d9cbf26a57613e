#include "program.h"

#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <sstream>

#include "natator/error.h"
#include "options.h"

namespace natator::cli {
namespace {

/// Says on one line of standard error what went wrong.
int complain(int status, const std::string& program, std::string message) {
    for (char& c : message) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    std::cerr << program << ": " << message << '\n';
    return status;
}

}  // namespace

int run_program(CLI::App& app, const int& status, int argc, char** argv) {
    const std::string program = app.get_name();
    app.require_subcommand(1);
    refuse_empty_values(app);
    return complaining(program, [&] {
        try {
            refuse_empty_values(argc, argv);
            app.parse(argc, argv);
        } catch (const CLI::Success& help_or_version) {
            std::ostringstream text;
            app.exit(help_or_version, text, text);
            print(text.str());
        } catch (const CLI::ParseError& error) {
            return complain(bad_input, program, std::string(error.what()) + "; see " + program + " --help");
        }
        return status;
    });
}

int complaining(const std::string& program, const std::function<int()>& work) {
    std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of print, not a death
    try {
        return work();
    } catch (const InputError& error) {
        return complain(bad_input, program, error.what());
    } catch (const NoDevice& error) {
        return complain(no_device, program, error.what());
    } catch (const std::bad_alloc&) {
        return complain(failure, program, "out of memory");
    } catch (const std::exception& error) {
        return complain(failure, program, error.what());
    }
}

void print(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw std::runtime_error("standard output cannot be written");
    }
}

}  // namespace natator::cli
