#include <algorithm>
#include <memory>

#include "../commands.h"
#include "../options.h"
#include "natator/error.h"
#include "study_options.h"
#include "water/water_study.h"

namespace natator::cli {

using namespace natator::bench;

namespace {

/// Refuses a case of which the study does nothing.
void refuse_cases_left_out(const WaterStudy& study) {
    const bool conserving =
        std::ranges::any_of(study.settings, [](const Setting& one) { return one.scheme == Scheme::conserving; });
    for (const WaterCase& one : water_cases())
        if (one.held && !(study.held && conserving) && std::ranges::count(study.cases, one.name) > 0)
            throw InputError("--case = " + one.name +
                             ": runs in scheme conserving only, and not by --quick; must be left out");
}

}  // namespace

void add_water(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        WaterOptions water;
        std::vector<std::string> cases;
        std::vector<int> resolutions{20, 40};
    };
    const auto options = std::make_shared<Options>();
    std::vector<std::string> names;
    for (const WaterCase& one : water_cases()) names.push_back(one.name);
    options->cases = names;
    CLI::App* command = app.add_subcommand(
        "water", "How far a scheme is from being a fluid: cases whose outcome is known, with targets.");
    add_study_options(command, options->common, {"float"});
    command->add_option("--case", options->cases, "Cases.")->check(one_of(names))->capture_default_str();
    command->add_option("--resolution", options->resolutions, "Particles along a case's length.")
        ->check(whole_number_in(8, 200))
        ->capture_default_str();
    add_water_options(command, options->water);
    command->callback([options, command, &status] {
        const StudyOptions& common = options->common;
        WaterStudy study{options->cases, options->resolutions, settings_of(common, options->water.settings)};
        study.supports = options->water.supports;
        study.starts = options->water.starts;
        study.gpu = options->water.gpu();
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
