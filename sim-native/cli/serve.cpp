#include <unistd.h>

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

struct ServeOptions {
    BackendChoice backend;
    ExecutionOptions execution;
    std::size_t most = 1024;
    bool summary = false;
};

/// What was done for how many.
struct Tally {
    std::size_t requests = 0, evaluations = 0;
};

/// A job, and the ids of all requests of a batch that ask for it.
struct SharedJob {
    Job job;
    std::vector<json> ids;
};

void answer(const nlohmann::ordered_json& result) {
    print(result.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

void answer(const SharedJob& shared, const Evaluation& evaluation) {
    const Job& job = shared.job;
    for (const json& id : shared.ids) answer(result_json(id, evaluation, job.scene.scheme, job.request.precision));
}

void answer(const SharedJob& shared, const std::string& error) {
    for (const json& id : shared.ids) answer(error_json(id, error));
}

/// Jobs that one launch of the GPU can do: same scene, precision and device.
using GroupKey = std::tuple<std::string, std::string, Precision, int>;

/// Evaluates jobs on the GPU. When one of them cannot be done, none of the others is lost: they are done one by one.
void evaluate_group(const std::vector<SharedJob>& group) {
    std::vector<BatchMember> members;
    for (const auto& [job, ids] : group) members.push_back({job.gait, job.request.perturbation});
    try {
        const Job& first = group.front().job;
        const std::vector<Evaluation> evaluations = evaluate_on_gpu(
            first.scene, members, first.request.precision, first.backend.device, nullptr, first.backend.whole_gpu);
        for (std::size_t k = 0; k < group.size(); ++k) answer(group[k], evaluations[k]);
    } catch (const InputError& error) {
        if (group.size() == 1) return answer(group.front(), error.what());
        for (const SharedJob& shared : group) evaluate_group({shared});
    }
}

/// The jobs of a batch of requests, each once however many requests ask for it: all but their ids is the same. Lines
/// that are no request are answered at once.
std::vector<SharedJob> read_jobs(const std::vector<std::string>& lines, const BackendChoice& backend) {
    std::vector<SharedJob> jobs;
    std::map<std::string, std::size_t> by_request;
    for (const std::string& line : lines) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        json id;
        try {
            json value = parse_json(line, "request");
            id = request_id(value);
            const Job job = read_job(value, backend);
            value.erase("id");
            const auto [found, is_new] = by_request.try_emplace(value.dump(), jobs.size());
            if (is_new) jobs.push_back({job, {}});
            jobs[found->second].ids.push_back(id);
        } catch (const InputError& error) {
            answer(error_json(id, error.what()));
        }
    }
    return jobs;
}

/// Answers a batch of requests: those for the GPU in groups, the others one after another.
void serve_batch(const std::vector<std::string>& lines, ServeOptions& options, Tally& tally) {
    std::map<GroupKey, std::vector<SharedJob>> groups;
    for (const SharedJob& shared : read_jobs(lines, options.backend)) {
        const auto& [job, ids] = shared;
        tally.requests += ids.size();
        ++tally.evaluations;
        try {
            if (on_gpu(job.backend, job.scene)) {
                const Request& request = job.request;
                const GroupKey key{request.scene, request.overrides.dump(), request.precision, job.backend.device};
                groups[key].push_back(shared);
            } else {
                answer(shared, evaluate_job(job, options.execution.execution()));
            }
        } catch (const InputError& error) {
            answer(shared, error.what());
        } catch (const NoDevice& error) {
            answer(shared, error.what());
        }
    }
    for (const auto& [key, jobs] : groups) evaluate_group(jobs);
}

int serve(ServeOptions& options) {
    if (options.backend.name == "cuda") on_gpu(options.backend, {});  // ends the program if there is none
    constexpr std::chrono::milliseconds lull(5);
    LineQueue queue(STDIN_FILENO);
    Tally tally;
    for (;;) {
        const std::vector<std::string> lines = queue.take(options.most, lull);
        if (lines.empty()) break;
        serve_batch(lines, options, tally);
    }
    if (options.summary)
        std::cerr << "natator-sim: " << tally.requests << " requests, " << tally.evaluations << " evaluations\n";
    return ok;
}

}  // namespace

void add_serve(CLI::App& app, int& status) {
    CLI::App* command =
        app.add_subcommand("serve",
                           "Read JSON requests on standard input, one a line, and answer each with one line, in any "
                           "order, by its id. What comes together is computed together where the backend does batches, "
                           "and once where requests differ in nothing but their ids. Ends with the input.");
    const auto options = std::make_shared<ServeOptions>();
    add_backend_options(command, options->backend);
    command->add_option("--batch", options->most, "Most requests that are taken together.")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command->add_flag("--summary", options->summary,
                      "At the end, say on standard error how many requests took how many evaluations.");
    add_execution_options(command, options->execution);
    command->callback([options, &status] { status = serve(*options); });
}

}  // namespace natator::cli
