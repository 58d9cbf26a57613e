#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>

#include "base/field.h"
#include "base/side_by_side.h"
#include "base/strict_json.h"
#include "commands.h"
#include "job.h"
#include "line_queue.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "options.h"

namespace natator::cli {
namespace {

using nlohmann::json;

struct ServeOptions {
    BackendChoice backend;
    ExecutionOptions execution;
    std::size_t max_lines = 1024;
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
    static std::mutex one_line_at_a_time;
    const std::scoped_lock lock(one_line_at_a_time);
    print(result.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

void answer(const SharedJob& shared, const Evaluation& evaluation) {
    const Job& job = shared.job;
    for (const json& id : shared.ids) answer(result_json(id, evaluation, job.scene.scheme, job.request.precision));
}

void answer(const SharedJob& shared, const std::string& error) {
    for (const json& id : shared.ids) answer(error_json(id, error));
}

void answer(const SharedJob& shared, const MemberResult& result) {
    std::visit([&shared](const auto& one) { answer(shared, one); }, result);
}

/// Jobs that one launch of the GPU can do: same scene but for the arrangement of its water, precision and device.
using GroupKey = std::tuple<std::string, std::string, Precision, int>;

/// Evaluates jobs on the GPU, together but for those that cannot be done.
void evaluate_group(const std::vector<SharedJob>& group, const Execution& execution) {
    std::vector<BatchMember> members;
    for (const SharedJob& shared : group) members.push_back(member_of(shared.job));
    const Job& first = group.front().job;
    const auto together = [&](const std::vector<BatchMember>& some) {
        return evaluate_on_gpu(first.scene, some, batch_options(first.request.precision, first.backend, execution));
    };
    const std::vector<MemberResult> results = evaluate_members(first.scene, members, together);
    for (std::size_t k = 0; k < group.size(); ++k) answer(group[k], results[k]);
}

/// Groups that are computed at a time, so that the host's work for one goes on beside the kernels of others. More gain
/// nothing.
constexpr std::size_t groups_at_a_time = 4;

/// The jobs of a batch of requests, each once however many requests ask for it: all that counts but their ids is the
/// same. Lines that are no request are answered at once.
std::vector<SharedJob> read_jobs(const std::vector<std::string>& lines, const BackendChoice& backend) {
    std::vector<SharedJob> jobs;
    std::map<std::string, std::size_t> by_request;
    for (const std::string& line : lines) {
        json id;
        std::optional<std::string> failure;
        try {
            if (line.size() > limits::document_bytes) throw InputError("request: larger than 16 MiB");
            if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
            json value = parse_json(line, "request");
            id = request_id(value);
            const Job job = read_job(value, backend);
            value.erase("id");
            value.erase(fields::schema_key);
            const std::string all_else = value.dump();
            if (!by_request.contains(all_else)) {
                jobs.push_back({job, {}});
                by_request[all_else] = jobs.size() - 1;
            }
            jobs[by_request.at(all_else)].ids.push_back(id);
        } catch (const std::exception& error) {
            failure = message_of(error);
        }
        if (failure) answer(error_json(id, *failure));
    }
    return jobs;
}

/// The job's evaluation, or why there is none. None at all if it is for the GPU, to be grouped.
std::optional<MemberResult> evaluate_unless_on_gpu(const Job& job, const Execution& execution) {
    try {
        if (on_gpu(job.backend, job.scene)) return std::nullopt;
        return evaluate_job(job, execution);
    } catch (const std::exception& error) {  // one request that fails, such as for want of memory, ends no other
        return message_of(error);
    }
}

/// Answers a batch of requests: those for the GPU in groups, the others one after another.
void serve_batch(const std::vector<std::string>& lines, ServeOptions& options, Tally& tally) {
    const Execution execution = options.execution.execution();
    std::map<GroupKey, std::vector<SharedJob>> groups;
    for (const SharedJob& shared : read_jobs(lines, options.backend)) {
        const auto& [job, ids] = shared;
        tally.requests += ids.size();
        ++tally.evaluations;
        if (const auto result = evaluate_unless_on_gpu(job, execution)) {
            answer(shared, *result);
            continue;
        }
        const Request& request = job.request;
        groups[{request.scene, request.overrides.dump(), request.precision, job.backend.device}].push_back(shared);
    }
    std::vector<const std::vector<SharedJob>*> each;
    for (const auto& [key, jobs] : groups) each.push_back(&jobs);
    side_by_side(each.size(), [&](std::size_t k) { evaluate_group(*each[k], execution); }, groups_at_a_time);
}

int serve(ServeOptions& options) {
    if (options.backend.name == "cuda") on_gpu(options.backend, {});  // ends the program if there is none
    constexpr std::chrono::milliseconds lull(5);
    LineQueue queue(
        {.lines = options.max_lines, .bytes = limits::document_bytes, .waiting_bytes = limits::waiting_bytes});
    Tally tally;
    for (;;) {
        const std::vector<std::string> lines = queue.take(options.max_lines, lull);
        if (lines.empty()) break;
        serve_batch(lines, options, tally);
    }
    queue.check_end();
    if (options.summary)
        std::cerr << "natator-sim: " << tally.requests << (tally.requests == 1 ? " request, " : " requests, ")
                  << tally.evaluations << (tally.evaluations == 1 ? " evaluation\n" : " evaluations\n");
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
    command->add_option("--batch", options->max_lines, "Most requests that are taken together.")
        ->check(whole_number_in(1, 1 << 20))
        ->capture_default_str();
    command->add_flag("--summary", options->summary,
                      "At the end, say on standard error how many requests took how many evaluations.");
    add_execution_options(command, options->execution);
    command->callback([options, &status] { status = serve(*options); });
}

}  // namespace natator::cli
