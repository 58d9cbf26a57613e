#include <algorithm>
#include <memory>

#include "../commands.h"
#include "../options.h"
#include "base/text.h"
#include "natator/error.h"
#include "study_options.h"
#include "validation.h"

namespace natator::cli {

using namespace natator::bench;

namespace {

/// The modified pressure is for tanks that stay full, and rows do not tell it.
void refuse_modified_pressure(const std::vector<std::string>& settings) {
    for (const std::string& setting : settings)
        if (steps_of(setting).modified_pressure)
            throw InputError("--setting = " + quoted(setting) +
                             ": must be without m, a column that collapses is no tank that stays full");
}

}  // namespace

void add_validation(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        std::vector<std::string> parts{"dam-break", "tank"}, settings;
        ValidationStudy study;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("validation",
                                           "Front of a collapsing column against the experiment of Martin and Moyce "
                                           "(1952), density of the fluid at rest against other simulators.");
    add_study_options(command, options->common, {"float"});
    command->add_option("--part", options->parts, "dam-break, tank.")
        ->check(one_of({"dam-break", "tank"}))
        ->capture_default_str();
    command->add_option("--setting", options->settings,
                        "Substeps and iterations, such as 8x4. Default: 4x4 8x4; the tank also 8x2 8x8 16x4.");
    command->add_option("--width", options->study.width, "Particles along the base of the column.")
        ->check(whole_number_in(4, 100))
        ->capture_default_str();
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        ValidationStudy study = options->study;
        refuse_modified_pressure(options->settings);
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

}  // namespace natator::cli
