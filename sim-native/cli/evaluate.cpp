#include <cstdio>
#include <iostream>
#include <memory>

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
int evaluate_request(const std::string& text, bool plain, int threads, json& id) {
    const json value = parse_json(text, "request");
    id = request_id(value);
    const Request request = parse_request(value);
    const Scene scene = load_scene(request.scene, request.overrides);
    const Evaluation evaluation = evaluate(scene, gait_for(request, scene), request.precision, request.perturbation, {},
                                           {.threads = threads});
    const auto result = result_json(id, evaluation, scene.scheme, request.precision);
    print((plain ? result.at("fitness") : result).dump() + "\n");
    if (!evaluation.instability) return ok;
    const Instability& where = *evaluation.instability;
    std::cerr << "natator-sim: unstable: particle " << where.particle << " is not finite after stage " << where.stage
              << " at " << where.time << " s\n";
    return unstable;
}

int run_evaluate(bool plain, int threads) {
    json id;
    try {
        return evaluate_request(read_all(stdin, "request"), plain, threads, id);
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
    const auto plain = std::make_shared<bool>(false);
    command->add_flag("--plain", *plain, "Write only the fitness, as a number.");
    const auto threads = std::make_shared<int>(1);
    command
        ->add_option("--threads", *threads,
                     "Threads, for scenes of many thousand particles; the same bits for any number.")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command->callback([plain, threads, &status] { status = run_evaluate(*plain, *threads); });
}

}  // namespace natator::cli
