#include <memory>

#include "../backend.h"
#include "../commands.h"
#include "../options.h"
#include "gpu_speed.h"
#include "natator/limits.h"
#include "speed.h"
#include "study_options.h"

namespace natator::cli {

using namespace natator::bench;

void add_speed(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        std::vector<std::string> scenes = speed_scene_names();
        std::vector<int> threads{1};
        BackendChoice backend;
        std::vector<int> batches{1, 150};
        std::vector<std::string> settings;
        int repeats = 3;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "speed", "Run time of whole evaluations, with a state hash, peak memory and the share of every stage.");
    add_backend_options(command, options->backend);
    command->add_option("--batch", options->batches, "Evaluations at a time on the GPU.")
        ->check(whole_number_in(1, 1 << 20))
        ->capture_default_str();
    add_study_options(command, options->common, {"float"});
    command->add_option("--scene", options->scenes, "Scenes.")
        ->check(one_of(speed_scene_names()))
        ->capture_default_str();
    command->add_option("--threads", options->threads, "Threads inside one evaluation.")
        ->check(whole_number_in(1, limits::threads))
        ->capture_default_str();
    command->add_option("--setting", options->settings,
                        "Substeps and iterations, such as 2x4, or 1x2m for the modified pressure, instead of the "
                        "scene's; rows name them behind the scene.");
    add_repeats(command, options->repeats, "Runs of each; the fastest counts.");
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        const std::vector<SpeedScene> scenes = speed_scenes_at(options->scenes, options->settings);
        refuse_gpu_options_for_cpu(options->backend);
        const bool gpu = on_gpu(options->backend, {});
        ResultTable table = gpu ? ResultTable(common.output, gpu_speed_columns(), gpu_speed_key_columns)
                                : ResultTable(common.output, speed_columns(), speed_key_columns);
        ResultTable profile =
            gpu ? table_beside(common, "profile", gpu_speed_profile_columns(), gpu_speed_key_columns + 1)
                : table_beside(common, "profile", speed_profile_columns(), speed_key_columns);
        if (gpu)
            run_gpu_speed_study(
                {scenes, common.chosen_schemes(), common.chosen_precisions(), options->batches, options->backend.device,
                 options->repeats, common.quick, options->backend.whole_gpu, options->backend.without_lists},
                table, profile, report);
        else
            run_speed_study({scenes, common.chosen_schemes(), common.chosen_precisions(), options->threads,
                             options->repeats, common.quick},
                            table, profile, report);
        if (common.output.empty()) print(table.text() + profile.text());
        status = ok;
    });
}

}  // namespace natator::cli
