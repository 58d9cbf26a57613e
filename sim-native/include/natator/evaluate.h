#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "natator/gait.h"
#include "natator/scene.h"
#include "natator/snapshot.h"
#include "natator/solver.h"
#include "natator/start_cache.h"

namespace natator {

enum class Precision { single_precision, double_precision };
enum class Stopped { completed, touched_plane, no_progress, unstable };

/// Random shift of all starting positions, for ensembles of a chaotic system.
struct Perturbation {
    double amplitude = 0;  ///< each coordinate is shifted uniformly within +-amplitude, length
    std::uint64_t seed = 1;
};

/// How well the final state keeps the laws of mechanics.
struct LawFigures {
    double linear_momentum = 0;   ///< |sum of m v| / sum of |m v| over the body; 0 for a body that internal forces move
    double angular_momentum = 0;  ///< the same for m r x v about the body's centre of mass
    double density_error_mean = 0;  ///< mean over the fluid of max(density - 1, 0), densities in units of rest density
    double density_error_max = 0;
};

/// What one evaluation of a gait in a scene gives.
struct Evaluation {
    Stopped stopped = Stopped::completed;
    double distance = 0;   ///< change of mean x over the body's particles since time 0, length (thesis 2.6)
    double simulated = 0;  ///< s
    int frames = 0;
    std::uint64_t hash = 0;  ///< of the final positions and velocities
    std::optional<Instability> instability;
    LawFigures laws;
};

/// One body position per frame, for callers that want a trajectory.
using FrameObserver = std::function<void(double time, const std::vector<Eigen::Vector3d>& body_positions)>;

/// Settles the scene, or takes its settled start from the cache, and runs it with a gait until its duration or an early
/// stop. The result is the same, bit by bit, with and without it.
/// Throws InputError when the gait does not fit the scene, or the evaluation would cost too much (cost.h).
Evaluation evaluate(const Scene& scene, const Gait& gait, Precision precision = Precision::single_precision,
                    const Perturbation& perturbation = {}, const FrameObserver& on_frame = {},
                    const Execution& execution = {}, const SnapshotOrder& snapshot = {});

}  // namespace natator
