#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "protocol/particle_experiment.h"

/// Scheme flex against black-box measurements of NVIDIA Flex 1.2.0 (tests/conformance/README.md), on either backend.
namespace natator::test {

using nlohmann::json;

/// Where the measurements lie: a build that was moved to another machine is told by a variable.
inline std::filesystem::path data_dir() {
    const char* const moved = std::getenv("NATATOR_CONFORMANCE");
    return moved ? moved : NATATOR_CONFORMANCE_DIR;
}
inline const std::filesystem::path conformance_dir = data_dir();

inline json read(const std::filesystem::path& path) {
    std::ifstream file(path);
    return json::parse(file);
}

inline std::vector<std::string> files_of(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(conformance_dir / folder))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Largest difference of any two numbers at the same place; infinite where the shapes differ.
inline double max_difference(const json& a, const json& b) {
    if (a.is_number() && b.is_number()) return std::abs(a.get<double>() - b.get<double>());
    if (!a.is_array() || !b.is_array() || a.size() != b.size()) return INFINITY;
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, max_difference(a[i], b[i]));
    return largest;
}

inline double max_trace_difference(const json& measured, const json& computed) {
    if (measured.size() != computed.size()) return INFINITY;
    double largest = 0;
    for (std::size_t s = 0; s < measured.size(); ++s)
        for (const char* key : {"predicted", "iterations"})
            largest = std::max(largest, max_difference(measured[s].at(key), computed[s].at(key)));
    return largest;
}

/// Runs an experiment of a file unless it is left out; the name is that of the experiment.
using RunExperiment = std::function<json(const json& experiment, const std::string& name)>;

/// Positions after every iteration, from the experiment's start on with no correction in between. Rounding differs
/// from the measured program's and adds up, so the bound grows with the number of updates.
inline void expect_positions_after_every_iteration(const std::string& file, const json& exceptions,
                                                   const RunExperiment& run) {
    const json experiments = read(conformance_dir / "micro" / (file + ".json"));
    ASSERT_FALSE(experiments.empty());
    for (const json& measured : experiments) {
        const std::string name = measured["name"];
        if (exceptions.contains(name)) continue;
        const json computed = run(measured, name);
        ASSERT_EQ(computed["frames"].size(), measured["frames"].size()) << name;
        for (std::size_t f = 0; f < measured["frames"].size(); ++f) {
            const json& a = measured["frames"][f];
            const json& b = computed["frames"][f];
            const double bound = 5e-6 * a["frame"].get<int>();
            EXPECT_LT(max_difference(a["pos"], b["pos"]), bound) << name << " frame " << a["frame"];
            if (a.contains("substeps_trace")) {
                EXPECT_LT(max_trace_difference(a["substeps_trace"], b["substeps_trace"]), bound)
                    << name << " frame " << a["frame"];
            }
        }
    }
}

/// A velocity is a position difference over h, so rounding of positions (1e-7 times their size) is divided by h.
inline void expect_velocities_after_the_first_update(const std::string& file, const json& exceptions,
                                                     const RunExperiment& run) {
    for (const json& measured : read(conformance_dir / "micro" / (file + ".json"))) {
        const std::string name = measured["name"];
        if (exceptions.contains(name) || measured["frames"][0]["frame"] != 1) continue;
        const json computed = run(measured, name);
        const json& a = measured["frames"][0]["vel"];
        double fastest = 0;
        for (const json& row : a)
            for (const json& v : row) fastest = std::max(fastest, std::abs(v.get<double>()));
        EXPECT_LT(max_difference(a, computed["frames"][0]["vel"]), 2e-3 + 1e-5 * fastest) << name;
    }
}

/// The thesis scene over one frame of four substeps: every particle stays where Flex put it.
inline void expect_every_particle_after_a_frame(const std::string& file, const RunExperiment& run) {
    const json experiments = read(conformance_dir / "one_frame" / (file + ".json"));
    ASSERT_EQ(experiments.size(), 1u);
    const json& measured = experiments[0]["frames"][0];
    const json computed = run(experiments[0], file)["frames"][0];

    std::vector<double> distance;
    for (std::size_t i = 0; i < measured["pos"].size(); ++i) {
        double squared = 0;
        for (int k = 0; k < 3; ++k)
            squared += std::pow(measured["pos"][i][k].get<double>() - computed["pos"][i][k].get<double>(), 2);
        distance.push_back(std::sqrt(squared));
    }
    std::sort(distance.begin(), distance.end());
    EXPECT_LE(distance[distance.size() / 2], 1e-6);
    EXPECT_LE(distance.back(), 2e-4);
    EXPECT_LT(max_difference(measured["first_substep"]["iterations"], computed["first_substep"]["iterations"]), 1e-5);
    EXPECT_LT(max_difference(measured["rot"], computed["rot"]), 1e-4);
    EXPECT_LT(max_difference(measured["trans"], computed["trans"]), 2e-5);
}

}  // namespace natator::test
