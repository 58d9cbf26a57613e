#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench_scenes.h"
#include "natator/evaluate.h"
#include "natator/solver.h"

namespace natator::bench {

/// How a scene is computed.
struct Setting {
    Scheme scheme = Scheme::flex;
    Precision precision = Precision::single_precision;
    int substeps = 4;
    int iterations = 4;
    bool modified_pressure = false;
};

/// How finely time is cut, and what the iterations of scheme conserving look for, see
/// SolverParameters::modified_pressure.
struct Steps {
    int substeps = 4, iterations = 4;
    bool modified_pressure = false;

    std::string text() const;  ///< as steps_of reads it
};
/// Of "8x4": 8 substeps of 4 iterations; of "8x4m": for the modified pressure. Throws InputError, which names option
/// --setting, for anything else.
Steps steps_of(const std::string& text);
Steps steps_of(const Setting& setting);
void set_steps(const Steps& steps, SolverParameters& solver);

/// Times at which paths are compared, s. Later ones mean little: neighbouring paths part exponentially.
inline constexpr std::array<double, 2> path_times{0.1, 0.25};

/// A short run of a scene from its settled start to the last of path_times.
struct PathRun {
    using Places = std::vector<Eigen::Vector3d>;
    std::array<Places, path_times.size()> places;  ///< of the tracked particles at path_times, length
    double seconds = 0;                            ///< wall time of the frames alone
    double density_error_mean = 0;      ///< of max(rho - 1, 0) over the fluid at the end, in the scheme's own
    double density_error_max = 0;       ///< kernel and rest density
    double linear_momentum_error = 0;   ///< largest |sum of m v| over the largest sum of |m v|
    double angular_momentum_error = 0;  ///< the same of m (x - c) x v
    double energy_change = 0;           ///< kinetic and potential, from start to end, over the largest kinetic energy
    double spring_residual = 0;         ///< the largest, see Residuals, in the last substep of one more frame
    double cluster_residual = 0;        ///< likewise
    std::uint64_t hash = 0;             ///< of the final positions and velocities
    std::optional<Instability> instability;  ///< then the rest is void
};

/// The start from which all runs of a scene with one scheme set out: settled in double with the scene's own settings.
State<double> settled_start(const Subject& subject, Scheme scheme);

PathRun run_path(const Subject& subject, const Setting& setting, const State<double>& start);

/// Root mean square distance of the tracked particles: those of the body if there is one, else all.
double path_error(const PathRun::Places& places, const PathRun::Places& reference);

}  // namespace natator::bench
