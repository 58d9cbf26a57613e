#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "natator/error.h"
#include "natator/protocol.h"
#include "natator/scene_json.h"
#include "natator/strict_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;

/// The request's gait; without one, of a scene that needs none, an empty gait.
Gait gait_for(const Request& request, const Scene& scene) {
    if (request.gait) return *request.gait;
    const int actuators = scene.creature ? scene.creature->actuators() : 0;
    if (actuators == 0) return {};
    throw InputError("request: gait: missing; must be given, the creature has " + std::to_string(actuators) +
                     " actuators");
}

/// Evaluates one request. Sets `id` as soon as it is known, for messages.
int evaluate_request(const std::string& text, bool plain, const StartCache* starts, json& id) {
    const json value = parse_json(text, "request");
    id = request_id(value);
    const Request request = parse_request(value);
    const Scene scene = load_scene(request.scene, request.overrides);
    const Evaluation evaluation =
        evaluate(scene, gait_for(request, scene), request.precision, request.perturbation, {}, starts);
    const auto result = result_json(id, evaluation, scene.scheme, request.precision);
    print((plain ? result.at("fitness") : result).dump() + "\n");
    if (!evaluation.instability) return ok;
    const Instability& where = *evaluation.instability;
    std::cerr << "natator-sim: unstable: particle " << where.particle << " is not finite after stage " << where.stage
              << " at " << where.time << " s\n";
    return unstable;
}

int run_evaluate(bool plain, bool use_cache) {
    json id;
    try {
        const std::optional<StartCache> starts = use_cache ? StartCache::of_user() : std::nullopt;
        return evaluate_request(read_all(stdin, "request"), plain, starts ? &*starts : nullptr, id);
    } catch (const std::exception& error) {
        // Whoever reads the pipe gets an answer too; `main` adds the line on standard error and the exit code.
        if (!plain) print(error_json(id, error.what()).dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
        throw;
    }
}

}  // namespace

void add_evaluate(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand(
        "evaluate", "Read one JSON request on standard input, write one JSON result on standard output.");
    struct Options {
        bool plain = false, no_cache = false;
    };
    const auto options = std::make_shared<Options>();
    command->add_flag("--plain", options->plain, "Write only the fitness, as a number.");
    command->add_flag("--no-cache", options->no_cache,
                      "Settle the start anew instead of keeping it for the next time.");
    command->callback([options, &status] { status = run_evaluate(options->plain, !options->no_cache); });
}

}  // namespace natator::cli
