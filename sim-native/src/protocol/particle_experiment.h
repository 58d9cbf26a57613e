#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "natator/evaluate.h"
#include "natator/model.h"

namespace natator {

/// Raw particles and constraints given as data, without a scene: one entry of a particle file.
/// The format is described in tests/conformance/README.md.
struct ParticleExperiment {
    std::string name;
    Model model;
    double time_step = 1.0 / 60;  ///< of one update, s
    int substeps = 1;
};

/// Reads one experiment. `where` names it in messages. Throws InputError naming the field, its value and what is
/// allowed.
ParticleExperiment read_particle_experiment(const nlohmann::json& source, const std::string& where);

/// Runs an experiment and returns it with `frames` computed. The frames asked for are those the input lists, each with
/// the fields it lists (substeps_trace among them); without `frames` in the input it is frame 1 with positions and
/// velocities. An experiment that does not stay finite ends at that frame with the field `unstable`.
/// `gpu`: computes on the GPU of this number; throws NoDevice without it, InputError for what the GPU does not do.
nlohmann::json run_particle_experiment(const nlohmann::json& source, const std::string& where, Precision precision,
                                       std::optional<int> gpu = {});

}  // namespace natator
