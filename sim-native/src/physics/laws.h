// Laws of mechanics by which a State is told from one that has exploded, on the host and on devices. They are one-sided
// bounds: what breaks them is impossible, what keeps them need not be right.
#pragma once

#include "number.h"
#include "vec3.h"

namespace natator::physics {

/// Which law a State breaks.
enum class Law {
    none,
    finite,           ///< a value is not a finite number
    particle_energy,  ///< a particle is faster, or higher above where it began, than gravity and muscles can make it
    energy,           ///< all particles together have more energy than they began with and muscles gave them
    tank,             ///< a particle is behind a plane
    shape,            ///< a body is stretched to several times its length
    compression,      ///< the fluid is compressed to a fraction of its volume
    mach,             ///< a body in water on a lattice goes nearly as fast as its sound
};

inline constexpr double max_compression = 0.5;  ///< of a fluid: mean of max(density - 1, 0), in rest densities

/// Limits of a State's measures; infinite where nothing is asked.
struct LawLimits {
    double particle_energy;  ///< (length/s)^2: of v^2/2 - g x of any particle
    double energy;           ///< mass (length/s)^2: of the sum of m (v^2/2 - g x), beyond the muscles' work
    double depth;            ///< length: of any particle behind a plane
    double reach;            ///< length: of the body's particles from its first one
};

/// Measures of a State, with the particles that have the largest share in it. Starts as nothing; -1: no particle.
struct LawMeasures {
    double energy = 0;
    double particle_energy = -1e300, depth = -1e300, reach_square = 0;
    int most_energetic = -1, deepest = -1, farthest = -1;
};

inline namespace NATATOR_SET {

/// v^2/2 - g x, (length/s)^2: the energy of a particle over its mass.
template <class T>
NATATOR_HD T particle_energy(const Vec3<T>& velocity, const Vec3<T>& position, const Vec3<T>& gravity) {
    return T(0.5) * dot(velocity, velocity) - dot(gravity, position);
}

/// The measures of two sets of particles together; of equal ones the lower particle counts.
NATATOR_HD void add(LawMeasures& to, const LawMeasures& other) {
    const auto take = [](double& most, int& at, double value, int by) {
        if (by < 0 || !(value > most || (value == most && by < at) || at < 0)) return;
        most = value;
        at = by;
    };
    to.energy += other.energy;
    take(to.particle_energy, to.most_energetic, other.particle_energy, other.most_energetic);
    take(to.depth, to.deepest, other.depth, other.deepest);
    take(to.reach_square, to.farthest, other.reach_square, other.farthest);
}

/// The first law that is broken, and by which particle.
struct Breach {
    Law law = Law::none;
    int particle = -1;
};
NATATOR_HD Breach breach(const LawMeasures& m, const LawLimits& limits) {
    if (m.depth > limits.depth) return {Law::tank, m.deepest};
    if (m.particle_energy > limits.particle_energy) return {Law::particle_energy, m.most_energetic};
    if (m.reach_square > limits.reach * limits.reach) return {Law::shape, m.farthest};
    if (m.energy > limits.energy) return {Law::energy, m.most_energetic};
    return {};
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
