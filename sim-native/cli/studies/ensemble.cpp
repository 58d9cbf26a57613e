#include <memory>

#include "../commands.h"
#include "../options.h"
#include "ensemble.h"
#include "study_options.h"

namespace natator::cli {

using namespace natator::bench;

void add_ensemble(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        Grid grid{{2, 4, 8, 16}, {1, 4}};
        EnsembleStudy study;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "ensemble", "Distances of creatures 1 and 2 over 4 s: mean and spread over starts that differ a little.");
    add_study_options(command, options->common, {"float"});
    add_grid(command, options->grid);
    command->add_option("--creature", options->study.creatures, "1, 2.")
        ->check(whole_number_in(1, 2))
        ->capture_default_str();
    command->add_option("--runs", options->study.runs, "Runs per setting.")
        ->check(whole_number_in(1, 10000))
        ->capture_default_str();
    command->add_option("--perturbation", options->study.perturbation, "Largest shift of each coordinate, length.")
        ->check(number_in(0, 0.01))
        ->capture_default_str();
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        EnsembleStudy study = options->study;
        study.settings = settings_of(common, options->grid);
        if (common.quick) {
            study.duration = 0.1;
            study.runs = 2;
        }
        ResultTable table(common.output, ensemble_columns(), ensemble_key_columns);
        run_ensemble_study(study, table, report);
        const ResultTable summary = ensemble_summary(table.rows());
        finish(common, table, summary, "summary");
        report(summary.text());
        status = ok;
    });
}

}  // namespace natator::cli
