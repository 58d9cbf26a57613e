#include <memory>

#include "backend.h"
#include "base/field.h"
#include "base/strict_json.h"
#include "base/text.h"
#include "base/whole_file.h"
#include "commands.h"
#include "natator/error.h"
#include "options.h"
#include "output_file.h"
#include "protocol/particle_experiment.h"

namespace natator::cli {
namespace {

struct ParticlesOptions {
    std::string file;
    std::string output;
    std::string precision = "float";
    std::string backend = "cpu";
    int device = 0;
};

std::string experiment_name(const std::string& file, const nlohmann::json& experiment, std::size_t index) {
    std::string where = file + "[" + std::to_string(index) + "]";
    if (experiment.is_object() && experiment.contains("name")) where += " (" + shown(experiment["name"]) + ")";
    return where;
}

void run_particles(const ParticlesOptions& options, int& status) {
    const nlohmann::json experiments = read_json_file(options.file);
    if (!experiments.is_array()) fields::refuse({options.file, ""}, experiments, "an array of experiments");
    const Precision precision = precision_named(options.precision);
    refuse_gpu_options_for_cpu({.name = options.backend, .device = options.device});
    const std::optional<int> gpu = options.backend == "cuda" ? std::optional(options.device) : std::nullopt;
    if (!options.output.empty()) require_writable(options.output);
    nlohmann::json results = nlohmann::json::array();
    for (std::size_t i = 0; i < experiments.size(); ++i) {
        const std::string name = experiment_name(options.file, experiments[i], i);
        results.push_back(run_particle_experiment(experiments[i], name, precision, gpu));
        const auto& frames = results.back()["frames"];
        if (!frames.empty() && frames.back().contains("unstable")) status = unstable;
    }
    if (options.output.empty()) {
        print(results.dump() + "\n");
        return;
    }
    WholeFile file(options.output);
    file.stream() << results.dump() << '\n';
    if (!file.finish()) throw cannot_be_written(options.output);
}

}  // namespace

void add_particles(CLI::App& app, int& status) {
    const auto options = std::make_shared<ParticlesOptions>();
    CLI::App* command =
        app.add_subcommand("particles", "Run experiments on raw particles and write them back with results");
    command->add_option("file", options->file, "JSON array of experiments; format: tests/conformance/README.md")
        ->required();
    command->add_option("--output,-o", options->output, "Write here instead of standard output");
    command->add_option("--precision", options->precision, "float or double")->check(precision_name());
    command->add_option("--backend", options->backend, "cpu or cuda (a GPU)")
        ->check(one_of({"cpu", "cuda"}))
        ->capture_default_str();
    command->add_option("--device", options->device, "Number of the GPU, see natator-sim info")
        ->check(whole_number_in(0, 1023))
        ->capture_default_str();
    command->callback([options, &status] { run_particles(*options, status); });
}

}  // namespace natator::cli
