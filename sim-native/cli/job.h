#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "backend.h"
#include "natator/settled_state_cache.h"
#include "protocol/protocol.h"

namespace natator::cli {

/// A request with its scene loaded.
struct Job {
    Request request;
    Scene scene;
    Gait gait;
    BackendChoice backend;  ///< the request's, else the command's
};

/// Reads a request, one JSON object; `document` is what messages call it. Throws InputError.
Job read_job(const nlohmann::json& value, const BackendChoice& backend, const std::string& document = "request");

/// How a command's evaluations are run, without a say in what comes out.
struct ExecutionOptions {
    bool no_cache = false, no_skip = false;
    int threads = 1;
    std::optional<SettledStateCache> starts;  ///< filled by execution()

    Execution execution();
};

/// Adds --threads, --no-cache and --no-skip.
void add_execution_options(CLI::App* command, ExecutionOptions& options);

/// Evaluates one job by itself. Throws what evaluate and evaluate_on_gpu do.
Evaluation evaluate_job(const Job& job, const Execution& execution);

/// The job as one of a batch of the same scene but for the arrangement of its water.
BatchMember member_of(const Job& job);

/// How evaluate_on_gpu computes for a command; of `execution` its starts.
BatchOptions batch_options(Precision precision, const BackendChoice& backend, const Execution& execution);

/// evaluate_on_gpu for one member, if it does not cost too much.
Evaluation evaluate_one_on_gpu(const Scene& scene, const BatchMember& member, Precision precision,
                               const BackendChoice& backend, const Execution& execution);

}  // namespace natator::cli
