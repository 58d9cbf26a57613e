#pragma once

namespace natator {

/// What is left of constraints of one kind: 0 if there are none, or if they are met.
struct Residual {
    double max = 0;
    double mean = 0;  ///< over all of the kind
};

/// What a substep leaves of its constraints (Execution::residuals).
struct Residuals {
    double time = 0;     ///< s, at the substep's start
    int iterations = 0;  ///< that it took
    /// Of the fluid's particles, in rest densities. Scheme `conserving`: what the velocities would still have to take
    /// off in the substep, of at most `max_excess` (docs/theory.md, section 4.4). Scheme `flex`: excess over rest
    /// density, as the last iteration found it.
    Residual density{};
    /// Likewise what the velocities compress it by in a substep, after the pass on their divergence; scheme
    /// `conserving` alone.
    Residual divergence{};
    /// |C + alpha lambda| over rest length, C = length - rest length: of a stiff spring its stretch. In scheme `flex`
    /// |C| of all.
    Residual springs{};
    /// Way of a cluster's members from their goals, beyond what compliance leaves them, over the radius of particles.
    Residual clusters{};
};

}  // namespace natator
