#include <algorithm>
#include <iostream>
#include <memory>

#include "backend.h"
#include "commands.h"
#include "ensemble.h"
#include "gpu_roofline.h"
#include "gpu_speed.h"
#include "io/strict_json.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "options.h"
#include "precision.h"
#include "roofline.h"
#include "speed.h"
#include "stability.h"
#include "stage_cost.h"
#include "throughput.h"
#include "validation.h"
#include "water/water_study.h"

namespace natator::cli {
namespace {

using namespace natator::bench;

Scheme scheme_of(const std::string& name) {
    return name == to_string(Scheme::flex) ? Scheme::flex : Scheme::conserving;
}

/// What all studies are asked for.
struct Common {
    std::vector<std::string> schemes{"flex", "conserving"};
    std::vector<std::string> precisions;
    std::string output;
    bool quick = false;

    std::vector<Scheme> chosen_schemes() const {
        std::vector<Scheme> result;
        for (const std::string& name : schemes) result.push_back(scheme_of(name));
        return result;
    }
    std::vector<Precision> chosen_precisions() const {
        std::vector<Precision> result;
        for (const std::string& name : precisions)
            result.push_back(name == "double" ? Precision::double_precision : Precision::single_precision);
        return result;
    }
};

void report(const std::string& line) {
    std::cerr << line << '\n';
}

void add_common(CLI::App* command, Common& common, std::vector<std::string> precisions) {
    common.precisions = std::move(precisions);
    command->add_option("--scheme", common.schemes, "flex, conserving.")
        ->check(one_of({"flex", "conserving"}))
        ->capture_default_str();
    command->add_option("--precision", common.precisions, "float, double.")
        ->check(one_of({"float", "double"}))
        ->capture_default_str();
    command->add_option("--output,-o", common.output,
                        "CSV file; rows that it holds already are kept. Default: standard output.");
    command->add_flag("--quick", common.quick, "A small part of the study, in seconds.");
}

void add_repeats(CLI::App* command, int& repeats, const std::string& description) {
    command->add_option("--repeats", repeats, description)->check(whole_number_in(1, 1000))->capture_default_str();
}

/// Prints a table that has no file.
void finish(const Common& common, const ResultTable& table) {
    if (common.output.empty()) print(table.text());
}

void add_stability(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        std::vector<std::string> axes;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand(
        "stability", "Sweep one thing at a time to the point where it breaks: ok, diverged or unstable.");
    add_common(command, options->common, {"float"});
    command->add_option("--axis", options->axes, "What to sweep, such as dt or dt:iterations. Default: all.");
    command->callback([options, &status] {
        const Common& common = options->common;
        ResultTable table(common.output, stability_columns(), stability_key_columns);
        const StabilityStudy study{common.chosen_schemes(), common.chosen_precisions(), options->axes, common.quick};
        run_stability_study(study, table, report);
        finish(common, table);
        for (const std::string& place : where_only_flex_is_ok(table.rows())) report("only flex is ok: " + place);
        status = ok;
    });
}

/// How finely time is cut in a study.
struct Grid {
    std::vector<int> substeps, iterations;
};

void add_grid(CLI::App* command, Grid& grid) {
    command->add_option("--substeps", grid.substeps, "Substeps per frame.")
        ->check(whole_number_in(1, 1000))
        ->capture_default_str();
    command->add_option("--iterations", grid.iterations, "Iterations per substep.")
        ->check(whole_number_in(1, 1000))
        ->capture_default_str();
}

/// Prints a table that has no file, or writes a summary beside the one that has.
void finish(const Common& common, const ResultTable& table, const ResultTable& summary, const std::string& suffix) {
    if (common.output.empty())
        print(table.text());
    else
        summary.write(path_beside(common.output, suffix));
}

/// A second table of a study: in a file beside the first, in memory if that has none.
ResultTable table_beside(const Common& common, const std::string& suffix, Row columns, std::size_t key_columns) {
    return {common.output.empty() ? "" : path_beside(common.output, suffix), std::move(columns), key_columns};
}

void add_precision(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        Grid grid{{1, 2, 4, 8, 16, 32}, {1, 2, 4, 8, 16}};
        std::vector<std::string> scenes = subject_names();
        int repeats = 3;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand(
        "precision", "Run time against error over 0.25 s, for scenes x schemes x precisions x substeps x iterations.");
    add_common(command, options->common, {"float", "double"});
    command->add_option("--scene", options->scenes, "Scenes.")
        ->check(one_of(subject_names()))
        ->capture_default_str();
    add_grid(command, options->grid);
    add_repeats(command, options->repeats, "Time measurements per setting; their median counts.");
    command->callback([options, &status] {
        const Common& common = options->common;
        PrecisionStudy study{options->scenes,        common.chosen_schemes(),  common.chosen_precisions(),
                             options->grid.substeps, options->grid.iterations, options->repeats};
        if (common.quick) {
            study.scenes = {"hanging-chain", "bending-body"};
            study.substeps = {4, 8};
            study.iterations = {2};
            study.repeats = 1;
        }
        ResultTable table(common.output, precision_columns(), precision_key_columns);
        run_precision_study(study, table, report);
        const ResultTable orders = convergence_orders(table.rows());
        finish(common, table, orders, "orders");
        report(orders.text() + pareto_text(table.rows()));
        status = ok;
    });
}

void add_ensemble(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        Grid grid{{2, 4, 8, 16}, {1, 4}};
        EnsembleStudy study;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand(
        "ensemble", "Distances of creatures 1 and 2 over 4 s: mean and spread over starts that differ a little.");
    add_common(command, options->common, {"float"});
    add_grid(command, options->grid);
    command->add_option("--creature", options->study.creatures, "1, 2.")
        ->check(whole_number_in(1, 2))
        ->capture_default_str();
    command->add_option("--runs", options->study.runs, "Runs per setting.")
        ->check(whole_number_in(1, 10000))
        ->capture_default_str();
    command->add_option("--perturbation", options->study.perturbation, "Largest shift of each coordinate, length.")
        ->check(number_in(0, 0.01))
        ->capture_default_str();
    command->callback([options, &status] {
        const Common& common = options->common;
        EnsembleStudy study = options->study;
        for (const Scheme scheme : common.chosen_schemes())
            for (const Precision precision : common.chosen_precisions())
                for (const int substeps : options->grid.substeps)
                    for (const int iterations : options->grid.iterations)
                        study.settings.push_back({scheme, precision, substeps, iterations});
        if (common.quick) {
            study.duration = 0.1;
            study.runs = 2;
        }
        ResultTable table(common.output, ensemble_columns(), ensemble_key_columns);
        run_ensemble_study(study, table, report);
        const ResultTable summary = ensemble_summary(table.rows());
        finish(common, table, summary, "summary");
        report(summary.text());
        status = ok;
    });
}

/// The settings of substeps and iterations, written "8x4", for each scheme and precision asked for.
std::vector<Setting> settings_of(const Common& common, const std::vector<std::string>& texts) {
    std::vector<Setting> settings;
    for (const Scheme scheme : common.chosen_schemes())
        for (const Precision precision : common.chosen_precisions())
            for (const std::string& text : texts) {
                const Steps steps = steps_of(text);
                settings.push_back({scheme, precision, steps.substeps, steps.iterations});
            }
    return settings;
}

void add_validation(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        std::vector<std::string> parts{"dam-break", "tank"}, settings;
        ValidationStudy study;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand("validation",
                                              "Front of a collapsing column against the experiment of Martin and Moyce "
                                              "(1952), density of the fluid at rest against other simulators.");
    add_common(command, options->common, {"float"});
    command->add_option("--part", options->parts, "dam-break, tank.")
        ->check(one_of({"dam-break", "tank"}))
        ->capture_default_str();
    command->add_option("--setting", options->settings,
                        "Substeps and iterations, such as 8x4. Default: 4x4 8x4; the tank also 8x2 8x8 16x4.");
    command->add_option("--width", options->study.width, "Particles along the base of the column.")
        ->check(whole_number_in(4, 100))
        ->capture_default_str();
    command->callback([options, &status] {
        const Common& common = options->common;
        ValidationStudy study = options->study;
        std::vector<std::string> dam_break_settings{"4x4", "8x4"}, tank_settings{"4x4", "8x2", "8x4", "8x8", "16x4"};
        if (common.quick) {
            dam_break_settings = tank_settings = {"4x4"};
            study.width = 8;
            study.rest = study.window = 0.1;
        }
        if (!options->settings.empty()) dam_break_settings = tank_settings = options->settings;
        const auto chosen = [&options](const char* part) { return std::ranges::count(options->parts, part) > 0; };
        if (chosen("dam-break")) {
            for (const DamBreakCase& one : dam_break_cases()) study.dam_breaks.push_back(one.name);
            study.dam_break_settings = settings_of(common, dam_break_settings);
        }
        if (chosen("tank")) study.tank_settings = settings_of(common, tank_settings);
        ResultTable table(common.output, validation_columns(), validation_key_columns);
        ResultTable fronts = table_beside(common, "fronts", front_columns(), front_key_columns);
        run_validation_study(study, table, fronts, report);
        finish(common, table);
        status = ok;
    });
}

/// Refuses a case of which the study does nothing.
void refuse_cases_left_out(const WaterStudy& study) {
    const bool conserving = std::ranges::any_of(study.settings, [](const Setting& one) { return one.scheme == Scheme::conserving; });
    for (const WaterCase& one : water_cases())
        if (one.held && !(study.held && conserving) && std::ranges::count(study.cases, one.name) > 0)
            throw InputError("--case = " + one.name + ": runs in scheme conserving only, and not by --quick; must be left out");
}

void add_water(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        std::vector<std::string> cases, settings{"4x4"};
        std::vector<int> resolutions{20, 40};
        std::vector<double> supports{SolverParameters().kernelSupport};
        BackendChoice backend;
    };
    const auto options = std::make_shared<Options>();
    std::vector<std::string> names;
    for (const WaterCase& one : water_cases()) names.push_back(one.name);
    options->cases = names;
    CLI::App* command = bench->add_subcommand(
        "water", "How far a scheme is from being a fluid: cases whose outcome is known, with targets.");
    add_common(command, options->common, {"float"});
    add_backend_options(command, options->backend);
    command->add_option("--case", options->cases, "Cases.")->check(one_of(names))->capture_default_str();
    command->add_option("--resolution", options->resolutions, "Particles along a case's length.")
        ->check(whole_number_in(8, 200))
        ->capture_default_str();
    command->add_option("--setting", options->settings, "Substeps and iterations, such as 8x4.")->capture_default_str();
    command->add_option("--support", options->supports, "Of the kernel of scheme conserving, in particle distances.")
        ->check(number_in(2, 4))
        ->capture_default_str();
    command->callback([options, command, &status] {
        const Common& common = options->common;
        WaterStudy study{options->cases, options->resolutions, settings_of(common, options->settings)};
        study.supports = options->supports;
        refuse_gpu_options_for_cpu(options->backend);
        if (on_gpu(options->backend, {})) study.gpu = options->backend.device;
        if (common.quick && command->count("--resolution") == 0) study.resolutions = {10};
        study.held = !common.quick;
        if (command->count("--case") > 0) refuse_cases_left_out(study);
        ResultTable table(common.output, water_columns(), water_key_columns);
        ResultTable curves = table_beside(common, "curves", water_curve_columns(), water_curve_key_columns);
        run_water_study(study, table, curves, report);
        finish(common, table);
        status = ok;
    });
}

void add_speed(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        std::vector<std::string> scenes = speed_scene_names();
        std::vector<int> threads{1};
        BackendChoice backend;
        std::vector<int> batches{1, 150};
        std::vector<std::string> settings;
        int repeats = 3;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand(
        "speed", "Run time of whole evaluations, with a state hash, peak memory and the share of every stage.");
    add_backend_options(command, options->backend);
    command->add_option("--batch", options->batches, "Evaluations at a time on the GPU.")
        ->check(whole_number_in(1, 1 << 20))
        ->capture_default_str();
    add_common(command, options->common, {"float"});
    command->add_option("--scene", options->scenes, "Scenes.")
        ->check(one_of(speed_scene_names()))
        ->capture_default_str();
    command->add_option("--threads", options->threads, "Threads inside one evaluation.")
        ->check(whole_number_in(1, 1024))
        ->capture_default_str();
    command->add_option("--setting", options->settings,
                        "Substeps and iterations, such as 2x4, instead of the scene's; rows name them behind the scene.");
    add_repeats(command, options->repeats, "Runs of each; the fastest counts.");
    command->callback([options, &status] {
        const Common& common = options->common;
        const std::vector<SpeedScene> scenes = speed_scenes_at(options->scenes, options->settings);
        refuse_gpu_options_for_cpu(options->backend);
        if (on_gpu(options->backend, {})) {
            const GpuSpeedStudy study{scenes,            common.chosen_schemes(),   common.chosen_precisions(),
                                      options->batches, options->backend.device,   options->repeats,
                                      common.quick,     options->backend.whole_gpu};
            ResultTable table(common.output, gpu_speed_columns(), gpu_speed_key_columns);
            ResultTable profile = table_beside(common, "profile", gpu_speed_profile_columns(), gpu_speed_key_columns + 1);
            run_gpu_speed_study(study, table, profile, report);
            if (common.output.empty()) print(table.text() + profile.text());
            status = ok;
            return;
        }
        const SpeedStudy study{scenes,           common.chosen_schemes(), common.chosen_precisions(),
                               options->threads, options->repeats,        common.quick};
        ResultTable table(common.output, speed_columns(), speed_key_columns);
        ResultTable profile = table_beside(common, "profile", speed_profile_columns(), speed_key_columns);
        run_speed_study(study, table, profile, report);
        if (common.output.empty()) print(table.text() + profile.text());
        status = ok;
    });
}

void add_throughput(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        std::vector<int> particles = throughput_particles(), batches = throughput_batches();
        BackendChoice backend{.name = "cuda"};
        int repeats = 3;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand(
        "throughput", "How much water a GPU computes in a second, over the size of a scene and of a batch.");
    add_common(command, options->common, {"float"});
    add_gpu_options(command, options->backend);
    command->add_option("--particles", options->particles, "Fluid particles of a scene, about.")
        ->check(whole_number_in(least_throughput_particles, most_throughput_particles))
        ->capture_default_str();
    command->add_option("--batch", options->batches, "Evaluations at a time; with many particles only 1 is done.")
        ->check(whole_number_in(1, 1 << 20))
        ->capture_default_str();
    add_repeats(command, options->repeats, "Runs of each; the fastest counts.");
    command->callback([options, &status] {
        const Common& common = options->common;
        on_gpu(options->backend, {});
        ThroughputStudy study{common.chosen_schemes(), common.chosen_precisions(), options->particles,
                              options->batches,        options->backend.device,    options->repeats,
                              common.quick,            options->backend.whole_gpu};
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

void add_stages(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        StageCostStudy study{.features = stage_feature_names(), .schemes = {}};
    };
    const auto options = std::make_shared<Options>();
    StageCostStudy& asked = options->study;
    CLI::App* command = bench->add_subcommand(
        "stages", "What each stage costs in a scene that needs it and in one that does not, and without skipping.");
    add_common(command, options->common, {"float"});
    command->add_option("--feature", asked.features, "Features of a scene.")
        ->check(one_of(stage_feature_names()))
        ->capture_default_str();
    command->add_option("--state", asked.states, "off, on.")
        ->check(one_of({"off", "on"}))
        ->capture_default_str();
    command->add_flag("--skipped-only", asked.skipped_only, "Do not also run everything without skipping.");
    add_repeats(command, asked.repeats, "Runs of each; the fastest counts.");
    command->callback([options, &status] {
        const Common& common = options->common;
        StageCostStudy study = options->study;
        study.schemes = common.chosen_schemes();
        study.quick = common.quick;
        if (common.chosen_precisions() != std::vector{Precision::single_precision})
            throw InputError("--precision = double: must be float");
        ResultTable table(common.output, stage_cost_columns(), stage_cost_key_columns);
        run_stage_cost_study(study, table, report);
        finish(common, table);
        status = ok;
    });
}

void add_roofline(CLI::App* bench, int& status) {
    struct Options {
        Common common;
        BackendChoice backend;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench->add_subcommand(
        "roofline", "How near the stages come to what the processor can do: measured roofs, counted operations. On a GPU: "
                    "how near those of scheme conserving come to loops that only fetch.");
    command->add_option("--scheme", options->common.schemes, "flex, conserving; the latter alone on a GPU.")
        ->check(one_of({"flex", "conserving"}))
        ->capture_default_str();
    command->add_option("--output,-o", options->common.output,
                        "CSV file; rows that it holds already are kept. Default: standard output.");
    command->add_flag("--quick", options->common.quick, "A few frames only.");
    add_backend_options(command, options->backend);
    command->callback([options, &status] {
        const Common& common = options->common;
        if (on_gpu(options->backend, {})) {
            if (std::ranges::count(common.schemes, "conserving") == 0)
                throw InputError("--scheme = flex: must be conserving on a GPU");
            ResultTable table(common.output, gpu_roofline_columns(), gpu_roofline_key_columns);
            run_gpu_roofline_study({.device = options->backend.device, .quick = common.quick}, table, report);
            finish(common, table);
            status = ok;
            return;
        }
        RooflineStudy study{.schemes = common.chosen_schemes()};
        if (common.quick) study.frames = 2;
        ResultTable table(common.output, roofline_columns(), roofline_key_columns);
        run_roofline_study(study, table, report);
        finish(common, table);
        status = ok;
    });
}

}  // namespace

void add_studies(CLI::App& app, int& status) {
    add_precision(&app, status);
    add_ensemble(&app, status);
    add_roofline(&app, status);
    add_speed(&app, status);
    add_stability(&app, status);
    add_stages(&app, status);
    add_throughput(&app, status);
    add_validation(&app, status);
    add_water(&app, status);
    refuse_repeated_values(app);
}

}  // namespace natator::cli
