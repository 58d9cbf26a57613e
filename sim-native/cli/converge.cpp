#include <iostream>
#include <memory>

#include "commands.h"
#include "convergence_report.h"
#include "json_argument.h"
#include "level_runs.h"
#include "options.h"
#include "run_record.h"

namespace natator::cli {
namespace {

struct ConvergeOptions {
    std::string request, output;
    std::vector<std::string> levels{"time/2", "spacing/2"};
    int starts = 8;
    bool plain = false;
    BackendChoice backend;
    ExecutionOptions execution;
};

int run_converge(ConvergeOptions& options) {
    RunRecord record(options.output);
    std::vector<LevelRuns> levels =
        read_levels(read_request(options.request), request_name(options.request), options.levels, options.backend);
    bool all_stable = true;
    for (LevelRuns& runs : levels) {
        run_level(runs, options.starts, options.execution.execution(), record);
        all_stable = all_stable && runs.unstable_runs() == 0;
    }
    const std::optional<Estimate> estimate = estimate_speed(levels);
    const std::string table = convergence_table(levels, estimate);
    if (options.plain) {
        print(table);
    } else {
        std::cerr << table;
        print(convergence_json(levels, estimate).dump() + "\n");
    }
    return all_stable ? ok : unstable;
}

}  // namespace

void add_converge(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand("converge",
                                           "The same swim from several starts, as asked for, at half the "
                                           "time step and at half the spacing of the "
                                           "particles: how far its speed depends on them, and what it goes to. One "
                                           "JSON object on standard output, a table "
                                           "on standard error.");
    const auto options = std::make_shared<ConvergeOptions>();
    command->add_option(
        "request", options->request,
        "File or JSON text: a request as for `evaluate`; with a perturbation all starts are "
        "perturbed by its amplitude, else they are as `start` chooses them. Default, and -: standard input.");
    command->add_option("--starts", options->starts, "Starts 1 to this.")
        ->check(whole_number_in(2, 1000))
        ->capture_default_str();
    command->add_option("--levels", options->levels, "Of time/2, time/4, spacing/2 and both/2, beside the base.")
        ->delimiter(',')
        ->check(one_of({"time/2", "time/4", "spacing/2", "both/2"}))
        ->default_str("time/2,spacing/2");
    command->add_option(
        "--output", options->output,
        "File that gets a line for each run at its end; runs that it holds already are not done again.");
    command->add_flag("--plain", options->plain, "Write the table to standard output instead of JSON.");
    add_backend_options(command, options->backend);
    add_execution_options(command, options->execution);
    refuse_repeated_values(*command);
    command->callback([options, &status] { status = run_converge(*options); });
}

}  // namespace natator::cli
