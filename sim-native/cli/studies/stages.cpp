#include <memory>

#include "../commands.h"
#include "../options.h"
#include "natator/error.h"
#include "stage_cost.h"
#include "study_options.h"

namespace natator::cli {

using namespace natator::bench;

void add_stages(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        StageCostStudy study{.features = stage_feature_names(), .schemes = {}};
    };
    const auto options = std::make_shared<Options>();
    StageCostStudy& asked = options->study;
    CLI::App* command = app.add_subcommand(
        "stages", "What each stage costs in a scene that needs it and in one that does not, and without skipping.");
    add_study_options(command, options->common, {"float"});
    command->add_option("--feature", asked.features, "Features of a scene.")
        ->check(one_of(stage_feature_names()))
        ->capture_default_str();
    command->add_option("--state", asked.states, "off, on.")->check(one_of({"off", "on"}))->capture_default_str();
    command->add_flag("--skipped-only", asked.skipped_only, "Do not also run everything without skipping.");
    add_repeats(command, asked.repeats, "Runs of each; the fastest counts.");
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        StageCostStudy study = options->study;
        study.schemes = common.chosen_schemes();
        study.quick = common.quick;
        if (common.chosen_precisions() != std::vector{Precision::single_precision})
            throw InputError("--precision = double: must be float");
        ResultTable table(common.output, stage_cost_columns(), stage_cost_key_columns);
        run_stage_cost_study(study, table, report);
        finish(common, table);
        status = ok;
    });
}

}  // namespace natator::cli
