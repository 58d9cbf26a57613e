#include <memory>

#include "../commands.h"
#include "stability.h"
#include "study_options.h"

namespace natator::cli {

using namespace natator::bench;

void add_stability(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        std::vector<std::string> axes;
        bool modified_pressure = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "stability", "Sweep one thing at a time to the point where it breaks: ok, diverged or unstable.");
    add_study_options(command, options->common, {"float"});
    command->add_option("--axis", options->axes, "What to sweep, such as dt or dt:iterations. Default: all.");
    command->add_flag("--modified-pressure", options->modified_pressure,
                      "Scheme conserving solves for the modified pressure; rows do not tell, so give them a file of their own.");
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        ResultTable table(common.output, stability_columns(), stability_key_columns);
        const StabilityStudy study{common.chosen_schemes(), common.chosen_precisions(), options->axes, common.quick,
                                   options->modified_pressure};
        run_stability_study(study, table, report);
        finish(common, table);
        for (const std::string& place : where_only_flex_is_ok(table.rows())) report("only flex is ok: " + place);
        status = ok;
    });
}

}  // namespace natator::cli
