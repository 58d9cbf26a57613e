#include <algorithm>
#include <memory>

#include "../backend.h"
#include "../commands.h"
#include "../options.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "study_options.h"
#include "water/water_study.h"

namespace natator::cli {

using namespace natator::bench;

namespace {

constexpr int most_starts = 1'000'000;

/// Refuses a case of which the study does nothing.
void refuse_cases_left_out(const WaterStudy& study) {
    const bool conserving = std::ranges::any_of(study.settings, [](const Setting& one) { return one.scheme == Scheme::conserving; });
    for (const WaterCase& one : water_cases())
        if (one.held && !(study.held && conserving) && std::ranges::count(study.cases, one.name) > 0)
            throw InputError("--case = " + one.name + ": runs in scheme conserving only, and not by --quick; must be left out");
}

}  // namespace

void add_water(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        std::vector<std::string> cases, settings{"4x4"};
        std::vector<int> resolutions{20, 40};
        std::vector<double> supports{SolverParameters().kernelSupport};
        std::vector<int> starts{1};
        BackendChoice backend;
    };
    const auto options = std::make_shared<Options>();
    std::vector<std::string> names;
    for (const WaterCase& one : water_cases()) names.push_back(one.name);
    options->cases = names;
    CLI::App* command = app.add_subcommand(
        "water", "How far a scheme is from being a fluid: cases whose outcome is known, with targets.");
    add_study_options(command, options->common, {"float"});
    add_backend_options(command, options->backend);
    command->add_option("--case", options->cases, "Cases.")->check(one_of(names))->capture_default_str();
    command->add_option("--resolution", options->resolutions, "Particles along a case's length.")
        ->check(whole_number_in(8, 200))
        ->capture_default_str();
    command->add_option("--setting", options->settings, "Substeps and iterations, such as 8x4, or 8x4m for the modified pressure.")->capture_default_str();
    command->add_option("--support", options->supports, "Of the kernel of scheme conserving, in particle distances.")
        ->check(number_in(limits::least_kernel_support, limits::most_kernel_support))
        ->capture_default_str();
    command->add_option("--start", options->starts, "Of scheme conserving: each begins with its water disordered otherwise.")
        ->check(whole_number_in(1, most_starts))
        ->capture_default_str();
    command->callback([options, command, &status] {
        const StudyOptions& common = options->common;
        WaterStudy study{options->cases, options->resolutions, settings_of(common, options->settings)};
        study.supports = options->supports;
        study.starts = options->starts;
        refuse_gpu_options_for_cpu(options->backend);
        if (on_gpu(options->backend, {})) study.gpu = options->backend.device;
        if (common.quick && command->count("--resolution") == 0) study.resolutions = {10};
        study.held = !common.quick;
        if (command->count("--case") > 0) refuse_cases_left_out(study);
        ResultTable table(common.output, water_columns(), water_key_columns);
        ResultTable curves = table_beside(common, "curves", water_curve_columns(), water_curve_key_columns);
        run_water_study(study, table, curves, report);
        finish(common, table);
        status = ok;
    });
}

}  // namespace natator::cli
