#pragma once

#include "backend.h"
#include "natator/protocol.h"

namespace natator::cli {

/// A request with its scene loaded.
struct Job {
    Request request;
    Scene scene;
    Gait gait;
    BackendChoice backend;  ///< the request's, else the command's
};

/// Reads a request, one JSON object. Throws InputError.
Job read_job(const nlohmann::json& value, const BackendChoice& backend);

/// Evaluates one job by itself.
Evaluation evaluate_job(const Job& job, const Execution& execution);

}  // namespace natator::cli
