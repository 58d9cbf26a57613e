#include <memory>

#include "../backend.h"
#include "../commands.h"
#include "../options.h"
#include "study_options.h"
#include "throughput.h"

namespace natator::cli {

using namespace natator::bench;

void add_throughput(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        std::vector<int> particles = throughput_particles(), batches = throughput_batches();
        BackendChoice backend{.name = "cuda"};
        std::vector<std::string> settings;
        int repeats = 3;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "throughput", "How much water a GPU computes in a second, over the size of a scene and of a batch.");
    add_study_options(command, options->common, {"float"});
    add_gpu_options(command, options->backend);
    command->add_option("--particles", options->particles, "Fluid particles of a scene, about.")
        ->check(whole_number_in(min_throughput_particles, max_throughput_particles))
        ->capture_default_str();
    command->add_option("--batch", options->batches, "Evaluations at a time; with many particles only 1 is done.")
        ->check(whole_number_in(1, 1 << 20))
        ->capture_default_str();
    command->add_option("--setting", options->settings,
                        "Substeps and iterations, such as 2x4, or 1x2m for the modified pressure, instead of the "
                        "scene's; deep water may need more substeps, and gets them.");
    add_repeats(command, options->repeats, "Runs of each; the fastest counts.");
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        on_gpu(options->backend, {});
        ThroughputStudy study{
            common.chosen_schemes(),       common.chosen_precisions(), options->particles, options->batches,
            options->backend.device,       options->repeats,           common.quick,       options->backend.whole_gpu,
            options->backend.without_lists};
        if (!options->settings.empty()) study.settings.clear();
        for (const std::string& setting : options->settings) study.settings.push_back(steps_of(setting));
        if (common.quick) {
            study.particles = {1000, 8000};
            study.batches = {1, 4};
            study.repeats = 1;
        }
        ResultTable table(common.output, throughput_columns(), throughput_key_columns);
        run_throughput_study(study, table, report);
        finish(common, table);
        status = ok;
    });
}

}  // namespace natator::cli
