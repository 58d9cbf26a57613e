#include "job.h"

#include "natator/cost.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "natator/model.h"
#include "options.h"
#include "scene/scene_json.h"

namespace natator::cli {
namespace {

/// The request's gait; without one, of a scene that needs none, an empty gait.
Gait gait_for(const Request& request, const Scene& scene, const std::string& document) {
    if (request.gait) return *request.gait;
    const int actuators = scene.creature ? scene.creature->actuators() : 0;
    if (actuators == 0) return {};
    throw InputError(document + ": gait: missing; must be given, the creature has " + std::to_string(actuators) +
                     " actuators");
}

}  // namespace

Job read_job(const nlohmann::json& value, const BackendChoice& backend, const std::string& document) {
    Job job{.request = parse_request(value, document), .scene = {}, .gait = {}, .backend = backend};
    if (job.request.backend) job.backend.name = *job.request.backend;
    job.scene = load_scene(job.request.scene, job.request.overrides);
    if (job.request.start) job.request.perturbation = choose_start(*job.request.start, job.scene);
    job.gait = gait_for(job.request, job.scene, document);
    return job;
}

Execution ExecutionOptions::execution() {
    if (!no_cache && !starts) starts = SettledStateCache::of_user();
    return {.starts = starts ? &*starts : nullptr, .threads = threads, .skip = !no_skip};
}

void add_execution_options(CLI::App* command, ExecutionOptions& options) {
    command
        ->add_option("--threads", options.threads,
                     "Threads, for scenes of many thousand particles; the same bits for any number.")
        ->check(whole_number_in(1, limits::threads))
        ->capture_default_str();
    command->add_flag("--no-cache", options.no_cache, "Settle the start anew instead of keeping it for the next time.");
    command->add_flag("--no-skip", options.no_skip,
                      "Also run the stages that have nothing to do in the scene: the same bits, only slower.");
}

Evaluation evaluate_job(const Job& job, const Execution& execution) {
    const Request& request = job.request;
    if (!on_gpu(job.backend, job.scene))
        return evaluate(job.scene, job.gait,
                        {.precision = request.precision, .perturbation = request.perturbation, .execution = execution});
    return evaluate_one_on_gpu(job.scene, {job.gait, request.perturbation}, request.precision, job.backend, execution);
}

BatchMember member_of(const Job& job) {
    return {job.gait, job.request.perturbation,
            job.scene.fluid ? std::optional(job.scene.fluid->disorder) : std::nullopt};
}

BatchOptions batch_options(Precision precision, const BackendChoice& backend, const Execution& execution) {
    return {.precision = precision,
            .device = backend.device,
            .whole_gpu = backend.whole_gpu,
            .without_lists = backend.without_lists,
            .starts = execution.starts};
}

Evaluation evaluate_one_on_gpu(const Scene& scene, const BatchMember& member, Precision precision,
                               const BackendChoice& backend, const Execution& execution) {
    check_evaluation_cost(scene, build_model(scene));
    return evaluate_on_gpu(scene, {member}, batch_options(precision, backend, execution)).front();
}

}  // namespace natator::cli
