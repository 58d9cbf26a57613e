#include <memory>

#include "../backend.h"
#include "../commands.h"
#include "../options.h"
#include "stability.h"
#include "study_options.h"

namespace natator::cli {

using namespace natator::bench;

namespace {

GpuSolverOptions gpu_options(const BackendChoice& choice) {
    const GpuPath whole = choice.without_lists ? GpuPath::whole_gpu_search : GpuPath::whole_gpu;
    return {.device = choice.device, .path = choice.whole_gpu || choice.without_lists ? whole : GpuPath::by_size};
}

}  // namespace

void add_stability(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        std::vector<std::string> axes;
        std::vector<std::string> scenes{stability_scenes().front().name};
        double duration = 1;
        BackendChoice backend;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("stability",
                                           "Sweep one thing, or two, to the point where it breaks a law: ok or "
                                           "unstable, and how much of what laws allow was used.");
    add_study_options(command, options->common, {"float"});
    command->add_option("--axis", options->axes, "What to sweep, such as dt or dt:iterations. Default: all.");
    std::vector<std::string> names;
    for (const StabilityScene& scene : stability_scenes()) names.push_back(scene.name);
    command->add_option("--scene", options->scenes, "What is put under stress.")
        ->check(one_of(names))
        ->capture_default_str();
    command->add_option("--duration", options->duration, "Of each run, s; at least 8 frames are run. Rows do not tell.")
        ->check(number_in(0.01, 1000))
        ->capture_default_str();
    add_backend_options(command, options->backend);
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        refuse_gpu_options_for_cpu(options->backend);
        StabilityStudy study{.schemes = common.chosen_schemes(),
                             .precisions = common.chosen_precisions(),
                             .axes = options->axes,
                             .quick = common.quick,
                             .scenes = options->scenes,
                             .duration = options->duration};
        if (on_gpu(options->backend, {})) study.gpu = gpu_options(options->backend);
        ResultTable table(common.output, stability_columns(), stability_key_columns);
        run_stability_study(study, table, report);
        finish(common, table);
        for (const std::string& place : where_only_flex_is_ok(table.rows())) report("only flex is ok: " + place);
        status = ok;
    });
}

}  // namespace natator::cli
