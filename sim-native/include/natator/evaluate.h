#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "natator/gait.h"
#include "natator/measure.h"
#include "natator/record.h"
#include "natator/scene.h"
#include "natator/solver.h"

namespace natator {

/// The type of number that States are computed in: float, or double for reference runs.
enum class Precision { single_precision, double_precision };

/// The name of a scheme in requests and results: "flex", "conserving", "lattice".
const char* to_string(Scheme scheme);
/// The name of a precision in requests and results: "float", "double".
const char* to_string(Precision precision);
/// The name of a reason in results: "completed", "touched-plane", "no-progress", "unstable", "reached".
const char* to_string(StopReason stopped);
/// A hash as in results: 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

/// Random shift of all starting positions, for ensembles of a chaotic system.
struct Perturbation {
    double amplitude = 0;    ///< each coordinate is shifted uniformly within +-amplitude, length
    std::uint64_t seed = 1;  ///< of the random numbers
};

/// Selects initial condition number `start` of a scene, as `start` of a request does. In schemes `conserving` and
/// `lattice` `start` seeds the arrangement of the water, which is stored in the scene; else the returned perturbation
/// shifts every coordinate by up to 0.001 of fluid_rest_distance. Throws InputError if `start` is below 0.
Perturbation choose_start(int start, Scene& scene);

/// How far the final state is from the laws of mechanics; all dimensionless.
struct ConservationErrors {
    double linear_momentum = 0;   ///< |sum of m v| / sum of |m v| over the body; 0 for a body that internal forces move
    double angular_momentum = 0;  ///< |sum of m r x v| / sum of |m r x v| over the body, about its centre of mass
    double density_error_mean = 0;  ///< mean over the fluid of max(density - 1, 0), densities in units of rest density
    double density_error_max = 0;   ///< the largest of them
};

/// Result of a companion, a swimmer beside the evaluated one.
struct CompanionResult {
    std::string creature;  ///< its name
    double distance = 0;   ///< change of its mean x, length
    Course course;         ///< where it went
};

/// What the water has lost because its tank moves along: water that enters in front is at rest.
struct WaterRenewal {
    int times = 0;                                       ///< number of times that it moved
    long particles = 0;                                  ///< sum over all times
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< taken away, mass length/s
    double kinetic_energy = 0;                           ///< taken away, mass length^2/s^2
};

/// Result of one evaluation of a gait in a scene.
struct Evaluation {
    StopReason stopped = StopReason::completed;  ///< why it ended
    double distance = 0;     ///< change of mean x over the body's particles since time 0, length (thesis 2.6)
    double simulated = 0;    ///< s
    int frames = 0;          ///< number of time steps
    std::uint64_t hash = 0;  ///< hash of the final positions and velocities
    std::optional<Instability> instability;   ///< none: it was stable
    ConservationErrors errors;                ///< at the end
    std::optional<SwimmingNumbers> swimming;  ///< see swimming_numbers
    /// Work that the swimmer's muscles did by their changes of length (Solver::muscle_works), mass length^2/s^2; none
    /// in scheme `flex`, which has no forces, and without muscles.
    std::optional<double> work;
    double smagorinsky = 0;  ///< FluidBlock::smagorinsky, by which the water was computed
    /// Greatest speed of a part of a body in scheme `lattice`, cells a substep: above 0.1 a shorter substep may change
    /// the distance much, above 0.3 a law is broken.
    double cells_per_step = 0;
    std::optional<Course> course;             ///< where the body went; none without a body
    std::vector<GoalResult> goals;            ///< result of each goal, in the scene's order
    std::optional<WaterRenewal> renewal;      ///< what a moving tank took from its water; none in another tank
    std::vector<CompanionResult> companions;  ///< result of each companion, in the scene's order

    /// The gait's fitness: the weighted sum of the scores of the scene's goals; without goals, the distance.
    double fitness() const;
};

/// One body position per frame, for callers that want a trajectory.
using FrameObserver = std::function<void(double time, const std::vector<Eigen::Vector3d>& body_positions)>;

/// How an evaluation is run, and what it reports while it runs. Only `precision` and `perturbation` affect the result.
struct EvaluationOptions {
    Precision precision = Precision::single_precision;  ///< what is computed in
    Perturbation perturbation{};                        ///< of all starting positions
    FrameObserver on_frame{};    ///< called for the settled start and after each frame; empty = not
    SnapshotRequest snapshot{};  ///< of all particles at one time
    Execution execution{};       ///< what it points to must live until evaluate returns
};

/// Settles the scene, or takes its settled start from the cache, and runs it with a gait until its duration or an early
/// stop. The result is the same, bit by bit, with and without the cache. May be called from several threads at once;
/// each calls its own `on_frame` and `snapshot.take`, and a profile is one thread's. On a GPU (Execution::gpu) the
/// State goes there and back in each frame; evaluate_on_gpu gives the same bits sooner. Throws InputError when the gait
/// does not fit the scene, or the evaluation would cost too much (cost.h), and what `on_frame` and `snapshot.take`
/// throw.
Evaluation evaluate(const Scene& scene, const Gait& gait, const EvaluationOptions& options = {});

}  // namespace natator
