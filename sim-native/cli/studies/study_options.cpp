#include "study_options.h"

#include <iostream>
#include <utility>

#include "../options.h"
#include "../program.h"
#include "natator/limits.h"

namespace natator::cli {

using namespace natator::bench;

namespace {

std::vector<Setting> settings_at(const StudyOptions& common, const std::vector<Steps>& steps) {
    std::vector<Setting> settings;
    for (const Scheme scheme : common.chosen_schemes())
        for (const Precision precision : common.chosen_precisions())
            for (const Steps& one : steps)
                settings.push_back({scheme, precision, one.substeps, one.iterations, one.modified_pressure});
    return settings;
}

}  // namespace

std::vector<Scheme> StudyOptions::chosen_schemes() const {
    std::vector<Scheme> result;
    for (const std::string& name : schemes)
        result.push_back(name == to_string(Scheme::flex) ? Scheme::flex : Scheme::conserving);
    return result;
}

std::vector<Precision> StudyOptions::chosen_precisions() const {
    std::vector<Precision> result;
    for (const std::string& name : precisions) result.push_back(precision_named(name));
    return result;
}

void add_study_options(CLI::App* command, StudyOptions& common, std::vector<std::string> precisions) {
    command->add_option("--scheme", common.schemes, "flex, conserving.")
        ->check(one_of({"flex", "conserving"}))
        ->capture_default_str();
    add_other_study_options(command, common, std::move(precisions));
}

void add_other_study_options(CLI::App* command, StudyOptions& common, std::vector<std::string> precisions) {
    common.precisions = std::move(precisions);
    command->add_option("--precision", common.precisions, "float, double.")
        ->check(precision_name())
        ->capture_default_str();
    command->add_option("--output,-o", common.output,
                        "CSV file; rows that it holds already are kept. Default: standard output.");
    command->add_flag("--quick", common.quick, "A small part of the study, in seconds.");
}

void add_repeats(CLI::App* command, int& repeats, const std::string& description) {
    command->add_option("--repeats", repeats, description)->check(whole_number_in(1, 1000))->capture_default_str();
}

void add_grid(CLI::App* command, Grid& grid) {
    command->add_option("--substeps", grid.substeps, "Substeps per frame.")
        ->check(whole_number_in(1, 1000))
        ->capture_default_str();
    command->add_option("--iterations", grid.iterations, "Iterations per substep.")
        ->check(whole_number_in(1, 1000))
        ->capture_default_str();
}

std::vector<Setting> settings_of(const StudyOptions& common, const Grid& grid) {
    std::vector<Steps> steps;
    for (const int substeps : grid.substeps)
        for (const int iterations : grid.iterations) steps.push_back({.substeps = substeps, .iterations = iterations});
    return settings_at(common, steps);
}

std::vector<Setting> settings_of(const StudyOptions& common, const std::vector<std::string>& texts) {
    std::vector<Steps> steps;
    for (const std::string& text : texts) steps.push_back(steps_of(text));
    return settings_at(common, steps);
}

std::optional<int> WaterOptions::gpu() const {
    refuse_gpu_options_for_cpu(backend);
    return on_gpu(backend, {}) ? std::optional(backend.device) : std::nullopt;
}

void add_water_options(CLI::App* command, WaterOptions& water) {
    add_backend_options(command, water.backend);
    command
        ->add_option("--setting", water.settings,
                     "Substeps and iterations, such as 8x4, or 8x4m for the modified pressure.")
        ->capture_default_str();
    command->add_option("--support", water.supports, "Of the kernel of scheme conserving, in particle distances.")
        ->check(number_in(limits::min_kernel_support, limits::max_kernel_support))
        ->capture_default_str();
    command
        ->add_option("--start", water.starts, "Of scheme conserving: each begins with its water disordered otherwise.")
        ->check(whole_number_in(1, 1'000'000))
        ->capture_default_str();
}

void report(const std::string& line) {
    std::cerr << line << '\n';
}

ResultTable table_beside(const StudyOptions& common, const std::string& suffix, Row columns, std::size_t key_columns) {
    return {common.output.empty() ? "" : path_beside(common.output, suffix), std::move(columns), key_columns};
}

void finish(const StudyOptions& common, const ResultTable& table) {
    if (common.output.empty()) print(table.text());
}

void finish(const StudyOptions& common, const ResultTable& table, const ResultTable& summary,
            const std::string& suffix) {
    if (common.output.empty())
        print(table.text());
    else
        summary.write(path_beside(common.output, suffix));
}

}  // namespace natator::cli
