#include "program.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <new>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/field.h"
#include "base/system.h"
#include "base/text.h"
#include "base/unfinished_file.h"
#include "natator/error.h"
#include "options.h"

namespace natator::cli {
namespace {

/// Says on one line of standard error what went wrong.
int complain(int status, const std::string& program, const std::string& message) {
    std::cerr << program << ": " << as_one_line(message) << '\n';
    return status;
}

/// The parser's words end with "--option = value"; what the value must be is in the option's type.
std::string fault_of_value(const CLI::App& command, const CLI::ConversionError& error) {
    const std::string text = error.what(), before = "Could not convert: ";
    if (!text.starts_with(before)) return text;
    const std::string given = text.substr(before.size());
    const CLI::Option* const option = command.get_option_no_throw(given.substr(0, given.find(' ')));
    if (option && option->get_items_expected_max() == 0) return given + ": must be true or false";
    const bool number = option && option->get_type_name().starts_with("FLOAT");  // of whole ones a range is given
    return given + (number ? ": must be a number" : ": cannot be read");
}

/// The parser puts a colon between an option and what a check says, which begins with "= value" where it is about a
/// value.
std::string fault_of_check(const CLI::ValidationError& error) {
    std::string text = error.what();
    const std::size_t colon = text.find(':');
    if (colon != std::string::npos && text.compare(colon, 3, ": =") == 0) text.erase(colon, 1);
    return text;
}

std::vector<std::string> command_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* one : command.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(one->get_name());
    return names;
}

/// "--option: At Most 1 required but received 2" or "--option: 1 required TEXT missing" in the parser's words.
std::string fault_of_number(const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    return text.substr(0, text.find(':')) + (text.find("received") != std::string::npos
                                                 ? ": is given more than once; must be given once"
                                                 : ": has no value; must have one");
}

/// "option is required" in the parser's words, "A subcommand is required" where there is no command.
std::string fault_of_missing(const CLI::App& command, const CLI::RequiredError& error) {
    if (command.get_require_subcommand_min() > 0) return "command: missing; must be " + any_of(command_names(command));
    const std::string text = error.what();
    return text.substr(0, text.find(" is required")) + ": missing; must be given";
}

/// What is wrong with a command line. The parser alone does not name a command that it does not know, names options
/// together with their values, and does not say what a value must be.
std::string fault_of(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    if (const auto* const conversion = dynamic_cast<const CLI::ConversionError*>(&error))
        return fault_of_value(*command, *conversion);
    if (const auto* const check = dynamic_cast<const CLI::ValidationError*>(&error)) return fault_of_check(*check);
    if (const auto* const number = dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return fault_of_number(*number);
    const std::vector<std::string> left_over = app.remaining(true);
    const auto* const missing = dynamic_cast<const CLI::RequiredError*>(&error);
    if (missing && left_over.empty()) return fault_of_missing(*command, *missing);
    if (left_over.empty()) return error.what();
    if (command->get_require_subcommand_min() > 0 && !left_over.front().starts_with('-')) {
        const std::string& word = left_over.front();
        const std::vector<std::string> names = command_names(*command);
        return "unknown command " + (word.empty() ? "\"\"" : word) +
               fields::did_you_mean(word, {names.begin(), names.end()});
    }
    if (!missing && dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return error.what();
    const auto option =
        std::find_if(left_over.begin(), left_over.end(), [](const auto& word) { return word.starts_with('-'); });
    if (option == left_over.end()) return "unexpected argument " + left_over.front();
    std::vector<std::string> names;
    for (const CLI::Option* one : command->get_options())
        for (const std::string& name : one->get_lnames()) names.push_back("--" + name);
    return "unknown option " + *option + fields::did_you_mean(*option, {names.begin(), names.end()});
}

}  // namespace

int run_program(CLI::App& app, const int& status, int argc, char** argv) {
    const std::string program = app.get_name();
    app.require_subcommand(1);
    refuse_missing_values(app);
    refuse_other_bases(app);
    return report_errors(program, [&] {
        try {
            refuse_empty_values(argc, argv);
            app.parse(argc, argv);
        } catch (const CLI::Success& help_or_version) {
            std::ostringstream text;
            app.exit(help_or_version, text, text);
            print(text.str());
        } catch (const CLI::ParseError& error) {
            return complain(bad_input, program, fault_of(app, error) + "; see " + program + " --help");
        }
        return status;
    });
}

int report_errors(const std::string& program, const std::function<int()>& work) {
    system::prepare_program(remove_unfinished_files);
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
        throw std::runtime_error("standard output cannot be written: " + std::generic_category().message(errno));
    }
}

}  // namespace natator::cli
