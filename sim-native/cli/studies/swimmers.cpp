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
        SwimmerStudy study{
            .cases = swim_case_names(), .resolutions = {16, 24, 32}, .settings = {}, .supports = {}, .machs = {0.15}};
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "swimmers", "Bodies of imposed motion that swim freely, or are towed, beside what the literature has of them.");
    options->common.schemes = {"conserving", "lattice"};
    command
        ->add_option(
            "--scheme", options->common.schemes,
            "conserving: water of particles; lattice: of the D3Q27 lattice's cells, which converges, in float alone.")
        ->capture_default_str();
    add_other_study_options(command, options->common, {"float"});
    SwimmerStudy& study = options->study;
    command->add_option("--case", study.cases, "Files of references/swimmers by name, or paths that end in .json.")
        ->capture_default_str();
    command->add_option("--resolution", study.resolutions, "Particles or cells along the body.")
        ->check(whole_number_in(8, 1000))
        ->capture_default_str();
    command
        ->add_option(
            "--box", study.boxes,
            "Size of the box of water, of the usual one: 2.3 x 1.2 lengths, 0.8 high; of scheme lattice 4 x 2, 1 high.")
        ->check(number_in(0.8, 10))
        ->capture_default_str();
    command
        ->add_option(
            "--pressure", study.pressures,
            "Of scheme conserving: by gravity, at the middle of the box, in densities of water times (length/beat)^2.")
        ->check(number_in(0.01, 100))
        ->capture_default_str();
    command
        ->add_option(
            "--mach", study.machs,
            "Of scheme lattice: Mach number of 1.2 lengths a beat, about a tail's speed; the step is in proportion.")
        ->check(number_in(0.01, 0.5))
        ->capture_default_str();
    command->add_option("--beats", study.beats, "Of the tail; the last 3 are counted, with --quick the last.")
        ->check(whole_number_in(1, 1000))
        ->capture_default_str();
    add_water_options(command, options->water);
    command->callback([options, command, &study, &status] {
        const StudyOptions& common = options->common;
        for (const std::string& scheme : common.schemes) {
            if (scheme == "conserving" || scheme == "lattice") continue;
            throw InputError("--scheme = " + scheme +
                             (scheme == "flex" ? ": has no forces on a body" : ": is unknown") +
                             "; must be conserving or lattice");
        }
        const bool conserving = std::ranges::count(common.schemes, "conserving") > 0,
                   lattice = std::ranges::count(common.schemes, "lattice") > 0;
        for (const char* option : {"--setting", "--support", "--start", "--pressure"})
            if (!conserving && command->count(option) > 0)
                throw InputError(std::string(option) + ": is of scheme conserving; must be left out");
        if (!lattice && command->count("--mach") > 0)
            throw InputError("--mach: is of scheme lattice; must be left out");
        if (lattice && std::ranges::count(common.precisions, "double") > 0)
            throw InputError(
                "--precision = double: scheme lattice computes in float; must be float, or --scheme conserving");
        if (conserving) {
            StudyOptions particles = common;
            particles.schemes = {"conserving"};
            study.settings = settings_of(particles, options->water.settings);
        }
        if (!lattice) study.machs.clear();
        for (const std::string& name : study.cases)
            if (!name.ends_with(".json") && std::ranges::count(swim_case_names(), name) == 0)
                throw InputError("--case = " + name + ": must be " + joined(swim_case_names(), ", ") +
                                 ", or a path that ends in .json");
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
