#include <iostream>
#include <memory>

#include "commands.h"
#include "stability.h"

namespace natator::cli {
namespace {

using namespace natator::bench;

/// What all studies are asked for.
struct Common {
    std::vector<std::string> schemes{"flex", "conserving"};
    std::vector<std::string> precisions;
    std::string output;
    bool quick = false;

    std::vector<Scheme> chosen_schemes() const {
        std::vector<Scheme> result;
        for (const std::string& name : schemes) result.push_back(name == "flex" ? Scheme::flex : Scheme::conserving);
        return result;
    }
    std::vector<Precision> chosen_precisions() const {
        std::vector<Precision> result;
        for (const std::string& name : precisions)
            result.push_back(name == "double" ? Precision::double_precision : Precision::single_precision);
        return result;
    }
};

void report(const std::string& line) {
    std::cerr << line << '\n';
}

void add_common(CLI::App* command, Common& common, std::vector<std::string> precisions) {
    common.precisions = std::move(precisions);
    command->add_option("--scheme", common.schemes, "flex, conserving.")
        ->check(CLI::IsMember({"flex", "conserving"}))
        ->capture_default_str();
    command->add_option("--precision", common.precisions, "float, double.")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
    command->add_option("--output,-o", common.output,
                        "CSV file; rows that it holds already are kept. Default: standard output.");
    command->add_flag("--quick", common.quick, "A small part of the study, in seconds.");
}

void add_stability(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        std::vector<std::string> axes;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand(
        "stability", "Sweep one thing at a time to the point where it breaks: ok, diverged or unstable.");
    add_common(command, options->common, {"float"});
    command->add_option("--axis", options->axes, "What to sweep, such as dt or dt:iterations. Default: all.");
    command->callback([options, &status] {
        const Common& common = options->common;
        ResultTable table(common.output, stability_columns(), stability_key_columns);
        const StabilityStudy study{common.chosen_schemes(), common.chosen_precisions(), options->axes, common.quick};
        run_stability_study(study, table, report);
        if (common.output.empty()) print(table.text());
        for (const std::string& place : where_only_flex_is_ok(table.rows())) report("only flex is ok: " + place);
        status = ok;
    });
}

}  // namespace

void add_bench(CLI::App& app, int& status) {
    CLI::App* bench = app.add_subcommand("bench", "Run a study of the solver and write its results as CSV.");
    bench->require_subcommand(1);
    add_stability(bench, status);
}

}  // namespace natator::cli
