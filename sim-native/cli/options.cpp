#include "options.h"

#include <cstdlib>
#include <limits>
#include <memory>
#include <set>
#include <string_view>

#include "io/strict_json.h"
#include "natator/error.h"

namespace natator::cli {
namespace {

constexpr const char* empty_value = "the value is empty; must be left out or have one";

CLI::Validator within(double low, double high, const std::string& expected, const std::string& type) {
    const auto check = [low, high, expected](const std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool good = text.empty() || (*end == '\0' && low <= value && value <= high);
        return good ? std::string() : "expected " + expected + ", not " + text;
    };
    return CLI::Validator(check, type);
}

}  // namespace

void refuse_empty_values(CLI::App& app) {
    for (CLI::Option* option : app.get_options([](const CLI::Option* one) { return one->get_items_expected_max() > 0; }))
        option->check([](const std::string& value) {
            return std::string(value.empty() ? empty_value : "");
        });
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) refuse_empty_values(*command);
}

void refuse_empty_values(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i)
        if (const std::string_view word = argv[i]; word.starts_with("--") && word.find('=') == word.size() - 1)
            throw InputError(std::string(word.substr(0, word.size() - 1)) + ": " + empty_value);
}

void refuse_repeated_values(CLI::App& app) {
    for (CLI::Option* option : app.get_options([](const CLI::Option* one) { return one->get_items_expected_max() > 1; })) {
        const auto before = std::make_shared<std::set<std::string>>();
        option->check([before](const std::string& value) {
            return before->insert(value).second ? std::string() : value + " is given twice; must be given once";
        });
    }
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) refuse_repeated_values(*command);
}

CLI::Validator seconds() {
    return within(0, std::numeric_limits<double>::max(), "a number of seconds from 0", "SECONDS");
}

CLI::Validator number_in(double low, double high) {
    return within(low, high, "a number in [" + natator::number_text(low) + ", " + natator::number_text(high) + "]", "NUMBER");
}

}  // namespace natator::cli
