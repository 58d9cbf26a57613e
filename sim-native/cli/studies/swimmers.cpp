#include <algorithm>
#include <memory>

#include "../backend.h"
#include "../commands.h"
#include "../options.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "study_options.h"
#include "water/swimmer.h"
#include "water/swimmer_study.h"

namespace natator::cli {

using namespace natator::bench;

void add_swimmers(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        SwimmerStudy study{swim_case_names(), {16, 24, 32}, {}, {SolverParameters().kernelSupport}};
        std::vector<std::string> settings{"4x4"};
        BackendChoice backend;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "swimmers", "Bodies of imposed motion that swim freely, or are towed, beside what the literature has of them.");
    options->common.schemes = {"conserving"};
    add_study_options(command, options->common, {"float"});
    add_backend_options(command, options->backend);
    SwimmerStudy& study = options->study;
    command->add_option("--case", study.cases, "Files of references/swimmers by name, or paths that end in .json.")
        ->capture_default_str();
    command->add_option("--resolution", study.resolutions, "Particles along the body.")
        ->check(whole_number_in(8, 400))
        ->capture_default_str();
    command->add_option("--box", study.boxes, "Size of the box of water, of the usual one: 2.3 x 1.2 lengths, 0.8 high.")
        ->check(number_in(0.8, 10))
        ->capture_default_str();
    command->add_option("--pressure", study.pressures,
                        "By gravity, at the middle of the box, in densities of water times (length/beat)^2.")
        ->check(number_in(0.01, 100))
        ->capture_default_str();
    command->add_option("--beats", study.beats, "Of the tail; the last 3 are counted, with --quick the last.")
        ->check(whole_number_in(1, 1000))
        ->capture_default_str();
    command->add_option("--setting", options->settings,
                        "Substeps and iterations, such as 8x4, or 8x4m for the modified pressure; a beat has 120 frames.")
        ->capture_default_str();
    command->add_option("--support", study.supports, "Of the kernel, in particle distances.")
        ->check(number_in(limits::least_kernel_support, limits::most_kernel_support))
        ->capture_default_str();
    command->add_option("--start", study.starts, "Each begins with its water disordered otherwise.")
        ->check(whole_number_in(1, 1'000'000))
        ->capture_default_str();
    command->callback([options, command, &study, &status] {
        const StudyOptions& common = options->common;
        study.settings = settings_of(common, options->settings);
        for (const Setting& setting : study.settings)
            if (setting.scheme != Scheme::conserving)
                throw InputError("--scheme = flex: has no forces on a body; must be conserving");
        for (const std::string& name : study.cases)
            if (!name.ends_with(".json") && std::ranges::count(swim_case_names(), name) == 0)
                throw InputError("--case = " + name + ": must be " +
                                 joined(swim_case_names(), ", ") + ", or a path that ends in .json");
        refuse_gpu_options_for_cpu(options->backend);
        if (on_gpu(options->backend, {})) study.gpu = options->backend.device;
        study.quick = common.quick;
        if (common.quick && command->count("--resolution") == 0) study.resolutions = {12};
        if (common.quick && command->count("--beats") == 0) study.beats = 2;
        study.counted = common.quick ? 1 : std::min(study.beats, 3);
        ResultTable table(common.output, swimmer_columns(), swimmer_key_columns);
        ResultTable beats = table_beside(common, "beats", swimmer_beat_columns(), swimmer_key_columns + 1);
        run_swimmer_study(study, table, beats, report);
        finish(common, table, swimmer_targets(study, table), "targets");
        status = ok;
    });
}

}  // namespace natator::cli
