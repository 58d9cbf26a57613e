#include <algorithm>
#include <memory>

#include "../commands.h"
#include "../options.h"
#include "natator/error.h"
#include "study_options.h"
#include "water/swimmer.h"
#include "water/swimmer_study.h"

namespace natator::cli {

using namespace natator::bench;

void add_swimmers(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        WaterOptions water;
        SwimmerStudy study{swim_case_names(), {16, 24, 32}, {}, {}};
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "swimmers", "Bodies of imposed motion that swim freely, or are towed, beside what the literature has of them.");
    options->common.schemes = {"conserving"};
    add_study_options(command, options->common, {"float"});
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
    command->add_option("--beats", study.beats, "Of the tail, of 120 frames; the last 3 are counted, with --quick the last.")
        ->check(whole_number_in(1, 1000))
        ->capture_default_str();
    add_water_options(command, options->water);
    command->callback([options, command, &study, &status] {
        const StudyOptions& common = options->common;
        study.settings = settings_of(common, options->water.settings);
        for (const Setting& setting : study.settings)
            if (setting.scheme != Scheme::conserving)
                throw InputError("--scheme = flex: has no forces on a body; must be conserving");
        for (const std::string& name : study.cases)
            if (!name.ends_with(".json") && std::ranges::count(swim_case_names(), name) == 0)
                throw InputError("--case = " + name + ": must be " +
                                 joined(swim_case_names(), ", ") + ", or a path that ends in .json");
        study.supports = options->water.supports;
        study.starts = options->water.starts;
        study.gpu = options->water.gpu();
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
