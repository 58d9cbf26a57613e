#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../backend.h"
#include "natator/scene.h"
#include "path_run.h"
#include "result_table.h"

/// What the studies of natator-bench share of their options and of how they end.
namespace natator::cli {

/// What all studies are asked for.
struct StudyOptions {
    std::vector<std::string> schemes{"flex", "conserving"};
    std::vector<std::string> precisions;
    std::string output;  ///< a CSV file; empty: standard output
    bool quick = false;

    std::vector<Scheme> chosen_schemes() const;
    std::vector<Precision> chosen_precisions() const;
};

/// Adds --scheme, --precision, with these if it is not given, --output and --quick.
void add_study_options(CLI::App* command, StudyOptions& common, std::vector<std::string> precisions);
/// Those but --scheme.
void add_other_study_options(CLI::App* command, StudyOptions& common, std::vector<std::string> precisions);
/// Adds --repeats.
void add_repeats(CLI::App* command, int& repeats, const std::string& description);

/// How finely time is cut in a study.
struct Grid {
    std::vector<int> substeps, iterations;
};
/// Adds --substeps and --iterations.
void add_grid(CLI::App* command, Grid& grid);
/// The settings of substeps and iterations, a grid of them or written "8x4", for each scheme and precision asked for.
std::vector<bench::Setting> settings_of(const StudyOptions& common, const Grid& grid);
std::vector<bench::Setting> settings_of(const StudyOptions& common, const std::vector<std::string>& texts);

/// How studies of water in a tank compute it.
struct WaterOptions {
    std::vector<std::string> settings{"4x4"};
    std::vector<double> supports{SolverParameters().conserving.kernel_support};
    std::vector<int> starts{1};
    BackendChoice backend;

    /// Number of the GPU to compute on, if not on the CPU. Throws InputError where options of a GPU are given for a
    /// CPU.
    std::optional<int> gpu() const;
};
/// Adds --setting, --support, --start and those of the backend.
void add_water_options(CLI::App* command, WaterOptions& water);

/// Says on standard error how far a study is, or what came of it.
void report(const std::string& line);
/// A second table of a study: in a file beside the first, in memory if that has none.
bench::ResultTable table_beside(const StudyOptions& common, const std::string& suffix, bench::Row columns,
                                std::size_t key_columns);
/// Prints a table that has no file.
void finish(const StudyOptions& common, const bench::ResultTable& table);
/// Prints a table that has no file, or writes a summary beside the one that has.
void finish(const StudyOptions& common, const bench::ResultTable& table, const bench::ResultTable& summary,
            const std::string& suffix);

}  // namespace natator::cli
