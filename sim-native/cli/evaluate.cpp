#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "job.h"
#include "natator/strict_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;

struct Options {
    BackendChoice backend;
    bool plain = false, no_cache = false;
    int threads = 1;
};

/// Evaluates one request. Sets `id` as soon as it is known, for messages.
int evaluate_request(const std::string& text, const Options& options, const StartCache* starts, json& id) {
    const json value = parse_json(text, "request");
    id = request_id(value);
    const Job job = read_job(value, options.backend);
    const Evaluation evaluation = evaluate_job(job, {.starts = starts, .threads = options.threads});
    const auto result = result_json(id, evaluation, job.scene.scheme, job.request.precision);
    print((options.plain ? result.at("fitness") : result).dump() + "\n");
    if (!evaluation.instability) return ok;
    const Instability& where = *evaluation.instability;
    std::cerr << "natator-sim: unstable: particle " << where.particle << " is not finite after stage " << where.stage
              << " at " << where.time << " s\n";
    return unstable;
}

int run_evaluate(const Options& options) {
    json id;
    try {
        const std::optional<StartCache> starts = options.no_cache ? std::nullopt : StartCache::of_user();
        return evaluate_request(read_all(stdin, "request"), options, starts ? &*starts : nullptr, id);
    } catch (const std::exception& error) {
        // Whoever reads the pipe gets an answer too; `main` adds the line on standard error and the exit code.
        if (!options.plain)
            print(error_json(id, error.what()).dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
        throw;
    }
}

}  // namespace

void add_evaluate(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand(
        "evaluate", "Read one JSON request on standard input, write one JSON result on standard output.");
    const auto options = std::make_shared<Options>();
    add_backend_options(command, options->backend);
    command->add_flag("--plain", options->plain, "Write only the fitness, as a number.");
    command->add_flag("--no-cache", options->no_cache,
                      "Settle the start anew instead of keeping it for the next time.");
    command
        ->add_option("--threads", options->threads,
                     "Threads, for scenes of many thousand particles; the same bits for any number.")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command->callback([options, &status] { status = run_evaluate(*options); });
}

}  // namespace natator::cli
