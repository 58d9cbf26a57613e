#include <memory>

#include "../commands.h"
#include "../options.h"
#include "precision.h"
#include "study_options.h"

namespace natator::cli {

using namespace natator::bench;

void add_precision(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        Grid grid{{1, 2, 4, 8, 16, 32}, {1, 2, 4, 8, 16}};
        std::vector<std::string> scenes = subject_names();
        int repeats = 3;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "precision", "Run time against error over 0.25 s, for scenes x schemes x precisions x substeps x iterations.");
    add_study_options(command, options->common, {"float", "double"});
    command->add_option("--scene", options->scenes, "Scenes.")->check(one_of(subject_names()))->capture_default_str();
    add_grid(command, options->grid);
    add_repeats(command, options->repeats, "Time measurements per setting; their median counts.");
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        PrecisionStudy study{options->scenes,        common.chosen_schemes(),  common.chosen_precisions(),
                             options->grid.substeps, options->grid.iterations, options->repeats};
        if (common.quick) {
            study.scenes = {"hanging-chain", "bending-body"};
            study.substeps = {4, 8};
            study.iterations = {2};
            study.repeats = 1;
        }
        ResultTable table(common.output, precision_columns(), precision_key_columns);
        run_precision_study(study, table, report);
        const ResultTable orders = convergence_orders(table.rows());
        finish(common, table, orders, "orders");
        report(orders.text() + pareto_text(table.rows()));
        status = ok;
    });
}

}  // namespace natator::cli
