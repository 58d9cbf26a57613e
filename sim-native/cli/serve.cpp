#include <iostream>
#include <map>
#include <memory>
#include <tuple>

#include "commands.h"
#include "job.h"
#include "line_queue.h"
#include "natator/error.h"
#include "natator/strict_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;

struct Options {
    BackendChoice backend;
    std::size_t most = 1024;
    bool no_cache = false;
};

void answer(const nlohmann::ordered_json& result) {
    print(result.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

void answer(const Job& job, const Evaluation& evaluation) {
    answer(result_json(job.request.id, evaluation, job.scene.scheme, job.request.precision));
}

/// Jobs that one launch of the GPU can do: same scene, precision and device.
using GroupKey = std::tuple<std::string, std::string, Precision, int>;

/// Evaluates jobs on the GPU. When one of them cannot be done, none of the others is lost: they are done one by one.
void evaluate_group(const std::vector<Job>& jobs) {
    std::vector<BatchMember> members;
    for (const Job& job : jobs) members.push_back({job.gait, job.request.perturbation});
    try {
        const Job& first = jobs.front();
        const std::vector<Evaluation> evaluations =
            evaluate_on_gpu(first.scene, members, first.request.precision, first.backend.device);
        for (std::size_t k = 0; k < jobs.size(); ++k) answer(jobs[k], evaluations[k]);
    } catch (const InputError& error) {
        if (jobs.size() == 1) return answer(error_json(jobs.front().request.id, error.what()));
        for (const Job& job : jobs) evaluate_group({job});
    }
}

/// Answers a batch of requests: those for the GPU in groups, the others one after another.
void serve_batch(const std::vector<std::string>& lines, const Options& options, const StartCache* starts) {
    std::map<GroupKey, std::vector<Job>> groups;
    for (const std::string& line : lines) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        json id;
        try {
            const json value = parse_json(line, "request");
            id = request_id(value);
            const Job job = read_job(value, options.backend);
            if (on_gpu(job.backend, job.scene)) {
                const Request& request = job.request;
                groups[{request.scene, request.overrides.dump(), request.precision, job.backend.device}].push_back(job);
            } else {
                answer(job, evaluate_job(job, {.starts = starts}));
            }
        } catch (const InputError& error) {
            answer(error_json(id, error.what()));
        } catch (const NoDevice& error) {
            answer(error_json(id, error.what()));
        }
    }
    for (const auto& [key, jobs] : groups) evaluate_group(jobs);
}

int serve(const Options& options) {
    if (options.backend.name == "cuda") on_gpu(options.backend, {});  // ends the program if there is none
    const std::optional<StartCache> starts = options.no_cache ? std::nullopt : StartCache::of_user();
    constexpr std::chrono::milliseconds lull(5);
    LineQueue queue(std::cin);
    for (;;) {
        const std::vector<std::string> lines = queue.take(options.most, lull);
        if (lines.empty()) return ok;
        serve_batch(lines, options, starts ? &*starts : nullptr);
    }
}

}  // namespace

void add_serve(CLI::App& app, int& status) {
    CLI::App* command =
        app.add_subcommand("serve",
                           "Read JSON requests on standard input, one a line, and answer each with one line, in any "
                           "order, by its id. What "
                           "comes together is computed together where the backend does batches. Ends with the input.");
    const auto options = std::make_shared<Options>();
    add_backend_options(command, options->backend);
    command->add_option("--batch", options->most, "Most requests that are taken together.")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command->add_flag("--no-cache", options->no_cache, "Settle starts anew instead of keeping them for the next time.");
    command->callback([options, &status] { status = serve(*options); });
}

}  // namespace natator::cli
