#include "options.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "base/text.h"
#include "natator/error.h"

namespace natator::cli {
namespace {

constexpr const char* empty_value = "the value is empty; must be left out or have one";

/// The parser takes the name of an option for the value of the one before it.
std::string fault_of_presence(const std::string& value) {
    return value.empty()             ? empty_value
           : value.starts_with("--") ? "= " + value + ": must be a value, not an option"
                                     : "";
}

/// The parser takes 0x10 for 16, as a whole number 010 for 8.
std::string fault_of_base(const std::string& value, bool whole) {
    const std::string digits = value.substr(std::min(value.find_first_not_of(" \t\n\v\f\r+-"), value.size()));
    if (digits.starts_with("0x") || digits.starts_with("0X")) return "= " + value + ": must be a decimal number";
    const bool octal = whole && digits.size() > 1 && digits.starts_with('0');
    return octal ? "= " + value + ": must be a decimal number without a 0 before it" : "";
}

/// The check with the words of this program instead of its own. What is empty has another check.
CLI::Validator in_words(CLI::Validator check, const std::string& must_be) {
    const CLI::Validator own = check;
    return check.operation([own, must_be](const std::string& value) {
        return value.empty() || own(value).empty() ? std::string() : "= " + value + ": must be " + must_be;
    });
}

/// What is in another base has another check.
CLI::Validator within(double low, double high, const std::string& must_be, const std::string& type) {
    const auto check = [low, high](const std::string& text) {
        const std::optional<double> value = decimal_number(text);
        const bool passes = value ? low <= *value && *value <= high : !fault_of_base(text, false).empty();
        return std::string(passes ? "" : "beyond");
    };
    return in_words(CLI::Validator(check, type), must_be);
}

}  // namespace

std::string any_of(const std::vector<std::string>& words) {
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i)
        list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return list;
}

void refuse_missing_values(CLI::App& app) {
    for (CLI::Option* option :
         app.get_options([](const CLI::Option* one) { return one->get_items_expected_max() > 0; }))
        option->check(fault_of_presence);
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) refuse_missing_values(*command);
}

void refuse_other_bases(CLI::App& app) {
    for (CLI::Option* option : app.get_options()) {
        const std::string type = option->get_type_name();
        const bool whole = type.starts_with("INT") || type.starts_with("UINT");
        if (whole || type.starts_with("FLOAT"))
            option->check([whole](const std::string& value) { return fault_of_base(value, whole); });
    }
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) refuse_other_bases(*command);
}

void refuse_empty_values(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i)
        if (const std::string_view word = argv[i]; word.starts_with("--") && word.find('=') == word.size() - 1)
            throw InputError(std::string(word.substr(0, word.size() - 1)) + ": " + empty_value);
}

void refuse_repeated_values(CLI::App& app) {
    for (CLI::Option* option :
         app.get_options([](const CLI::Option* one) { return one->get_items_expected_max() > 1; })) {
        const auto before = std::make_shared<std::set<std::string>>();
        option->check([before](const std::string& value) {
            return before->insert(value).second ? std::string() : value + " is given twice; must be given once";
        });
    }
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        refuse_repeated_values(*command);
}

CLI::Validator seconds() {
    return within(0, std::numeric_limits<double>::max(), "a number of seconds from 0", "SECONDS");
}

CLI::Validator whole_number_in(int low, int high) {
    return in_words(CLI::Range(low, high),
                    "a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
}

CLI::Validator one_of(const std::vector<std::string>& words) {
    return in_words(CLI::IsMember(words), any_of(words));
}

CLI::Validator precision_name() {
    return one_of({to_string(Precision::single_precision), to_string(Precision::double_precision)});
}

Precision precision_named(const std::string& name) {
    return name == to_string(Precision::double_precision) ? Precision::double_precision : Precision::single_precision;
}

CLI::Validator number_in(double low, double high) {
    return within(low, high, "a number in [" + natator::number_text(low) + ", " + natator::number_text(high) + "]",
                  "NUMBER");
}

}  // namespace natator::cli
