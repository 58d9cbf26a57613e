#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <vector>

#include "backend.h"
#include "base/text.h"
#include "commands.h"
#include "gait_argument.h"
#include "job.h"
#include "json_argument.h"
#include "natator/error.h"
#include "natator/load_scene.h"
#include "options.h"
#include "stream_batch.h"

namespace natator::cli {
namespace {

struct StreamOptions {
    std::string scene, gait, overrides, scheme;
    std::string precision = "float";
    std::vector<std::string> fields{"position"};
    std::optional<int> start;
    std::string state, policy;  ///< files
    int swims = 1;
    StreamSettings settings;
    BackendChoice backend;
    ExecutionOptions execution;
};

constexpr std::size_t max_waiting = 64;  // commands, beside as many that were taken together

SimulationSetup read_setup(const StreamOptions& options) {
    SimulationSetup setup;
    setup.scene = options.scene;
    nlohmann::json overrides = read_overrides_argument(options.overrides);
    if (!options.scheme.empty()) overrides["scheme"] = options.scheme;
    setup.overrides = overrides.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    setup.start = options.start;
    setup.until = options.settings.until;
    if (!options.gait.empty()) setup.gait = read_gait_argument(options.gait);
    return setup;
}

stream::Fields read_fields(const std::vector<std::string>& names) {
    if (names.size() > 1 && std::find(names.begin(), names.end(), "none") != names.end())
        throw InputError(
            "--fields: none stands beside others; must be none alone, or some of position, velocity, density, force");
    stream::Fields fields{.position = false};
    for (const std::string& name : names) {
        fields.position |= name == "position";
        fields.velocity |= name == "velocity";
        fields.density |= name == "density";
        fields.force |= name == "force";
    }
    return fields;
}

std::string read_state(const std::string& name) {
    std::ifstream file(name, std::ios::binary);
    std::ostringstream content;
    if (!file || !(content << file.rdbuf()))
        throw InputError("--state: " + quoted(name) +
                         " cannot be read; must be a file of a STAT body, as save sends it");
    return std::move(content).str();
}

template <class Real>
void run_stream(StreamOptions& options) {
    Execution execution = options.execution.execution();
    const BatchSize size{.swims = options.swims, .threads = execution.threads};
    if (size.swims > 1) execution.threads = 1;
    const SimulationSetup setup = read_setup(options);
    execution.forces = options.settings.fields.force;
    if (execution.forces && size.swims > 1 && options.backend.name != "cpu")
        throw InputError(
            "--fields: force is not known of many swims on a GPU; must be without --batch, or with --backend cpu");
    SharedGpu shared;
    if (options.backend.name != "cpu" &&
        on_gpu(options.backend, load_scene(setup.scene, SceneOptions{setup.overrides, setup.data}))) {
        execution.gpu = options.backend.device;
        if (!execution.forces) execution.shared = &shared;
    }
    StreamBatch<Real> batch(setup, execution, options.settings, size);
    if (!options.state.empty()) batch.restore(read_state(options.state));
    LineQueue commands({.lines = std::max(max_waiting, static_cast<std::size_t>(2 * options.swims)),
                        .bytes = stream::max_command,
                        .waiting_bytes = max_waiting * stream::max_command,
                        .message_bytes = stream::max_message,
                        .letters = {std::string(stream::state_letters), std::string(stream::action_letters)}});
    batch.run(commands);
    commands.check_end();
}

int stream_scene(StreamOptions& options) {
    if (!stream::is_rate(options.settings.rate))
        throw InputError("--rate = " + number_text(options.settings.rate) + ": must be 0 or a number in [0.001, 1000]");
    options.settings.fields = read_fields(options.fields);
    options.settings.paused |= options.swims > 1;
    if (!options.policy.empty() && !options.gait.empty())
        throw InputError("--gait: must be left out with --policy, which drives in its place");
    if (!options.policy.empty()) options.settings.policy.emplace(options.policy);
    refuse_gpu_options_for_cpu(options.backend);
    precision_named(options.precision) == Precision::double_precision ? run_stream<double>(options)
                                                                      : run_stream<float>(options);
    return ok;
}

}  // namespace

void add_stream(CLI::App& app, int& status) {
    CLI::App* command =
        app.add_subcommand("stream",
                           "Run a scene that is watched and changed meanwhile: JSON commands on standard input, one a "
                           "line; binary frames on standard output (sim-native/protocol/stream.md). Ends with the "
                           "input.");
    const auto options = std::make_shared<StreamOptions>();
    StreamSettings& settings = options->settings;
    command->add_option("scene", options->scene, "Name or path of the scene.")->required();
    command->add_option("--gait", options->gait, "File or JSON text. Default: muscles at rest.");
    command->add_option(
        "--policy", options->policy,
        "File of a policy that was learned (natator.policy), which drives the swimmer in a closed loop.");
    command->add_option("--overrides", options->overrides, "File or JSON text merged into the scene (RFC 7386).");
    command->add_option("--scheme", options->scheme, "Update rule: flex, conserving or lattice. Default: the scene's.");
    command->add_option("--precision", options->precision, "float or double.")
        ->check(precision_name())
        ->capture_default_str();
    command
        ->add_option("--start", options->start, "Which of its many starts, as in a request. Default: the scene's own.")
        ->check(whole_number_in(0, 2147483647));
    command->add_option("--state", options->state, "File of a saved moment of this scene, to begin at.");
    command
        ->add_option("--fields", options->fields,
                     "What frames hold of particles: position, velocity, density, force of the water; none.")
        ->delimiter(',')
        ->check(one_of({"position", "velocity", "density", "force", "none"}))
        ->capture_default_str();
    command
        ->add_option("--batch", options->swims,
                     "This many swims side by side; --threads: of which so many at a time. They begin paused.")
        ->check(whole_number_in(1, stream::max_swims))
        ->capture_default_str();
    command->add_option("--every", settings.every, "Offer every Nth frame only.")
        ->check(whole_number_in(1, 1'000'000))
        ->capture_default_str();
    command
        ->add_option("--rate", settings.rate,
                     "Simulated seconds per second of wall time, at most; 0: as fast as possible.")
        ->capture_default_str();
    command
        ->add_option("--until", settings.until,
                     "End at this time, s: after the nearest whole number of frames, at least one.")
        ->check(seconds());
    command->add_flag("--lossless", settings.lossless, "Wait for credit instead of dropping frames.");
    command->add_flag("--paused", settings.paused, "Begin paused.");
    add_stream_backend_options(command, options->backend);
    add_execution_options(command, options->execution);
    refuse_repeated_values(*command);
    command->callback([options, &status] { status = stream_scene(*options); });
}

}  // namespace natator::cli
