#include <iostream>
#include <memory>

#include "base/system.h"
#include "commands.h"
#include "job.h"
#include "json_argument.h"
#include "natator/error.h"

namespace natator::cli {
namespace {

using nlohmann::json;

struct EvaluateOptions {
    std::string request;
    BackendChoice backend;
    ExecutionOptions execution;
    bool plain = false;
};

/// Evaluates the request. Sets `id` as soon as it is known, for messages.
int evaluate_request(EvaluateOptions& options, json& id) {
    const json value = read_request(options.request);
    id = request_id(value);
    const Job job = read_job(value, options.backend, request_name(options.request));
    refuse_gpu_options_for_cpu(job.backend);
    const Evaluation evaluation = evaluate_job(job, options.execution.execution());
    const auto result = result_json(id, evaluation, job.scene.scheme, job.request.precision);
    print((options.plain ? result.at("fitness") : result).dump() + "\n");
    if (!evaluation.instability) return ok;
    std::cerr << "natator-sim: unstable: " << sentence_of(*evaluation.instability) << "\n";
    return unstable;
}

int run_evaluate(EvaluateOptions& options) {
    json id;
    try {
        return evaluate_request(options, id);
    } catch (const std::exception& error) {
        // Whoever reads the pipe gets an answer too; `main` adds the line on standard error and the exit code. A person
        // who sees both needs it once.
        if (!options.plain && !system::is_output_terminal())
            print(error_json(id, message_of(error)).dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
        throw;
    }
}

}  // namespace

void add_evaluate(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand(
        "evaluate",
        "Read one JSON request, write one JSON result on standard output. The request holds all that `run` has options "
        "for: scene, gait, scheme, duration, overrides.");
    const auto options = std::make_shared<EvaluateOptions>();
    command->add_option("request", options->request, "File or JSON text: the request. Default, and -: standard input.");
    add_backend_options(command, options->backend);
    command->add_flag("--plain", options->plain, "Write only the fitness, as a number.");
    add_execution_options(command, options->execution);
    command->callback([options, &status] { status = run_evaluate(*options); });
}

}  // namespace natator::cli
