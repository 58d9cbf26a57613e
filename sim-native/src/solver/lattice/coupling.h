#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "natator/model.h"
#include "water.h"

namespace natator::lattice {

/// The water of a Model of scheme `lattice` and the particles in it, substep by substep: a substep is a step of the
/// water. What the water gives a particle comes to it as a running mean, half of it at once, or less of a particle
/// smaller than two cells or lighter than its water: all at once, particles of two cells swing ever more from step to
/// step (free particles, measured: 1.02 times). Nothing of it is lost. At first, and wherever a State's time does
/// not go on from where the last one ended, all water goes with the box' current.
template <class Real>
class Coupling {
public:
    /// `gpu`: its number; none: on the CPU.
    Coupling(const Model& model, int threads, std::optional<int> gpu);

    /// Gives the particles what the water gave them in the last substep, and their weight in it, in one of so long, s.
    void push(State<Real>& state, double h);
    /// The water's step, once the particles have made theirs to `time`, s.
    void follow(const State<Real>& state, double h, double time);
    /// Moves all water by -by, length: a whole number of cells. The caller moves the State's particles.
    void shift(const Eigen::Vector3d& by);
    /// All that goes from one substep to the next, the water with it.
    void save(ByteWriter& to) const;
    /// Takes what `save` wrote. Throws InputError when it is not of this, and then nothing has changed.
    void restore(ByteReader from);
    /// All cells of the water; at rest before the first step.
    WaterField field() const;
    /// Begins to sum what the water does to the particles, see Solver::forces.
    void clear_forces();
    std::vector<Vector3<Real>> forces() const;
    /// The greatest speed of a particle in a substep so far, cells.
    double fastest() const { return fastest_; }
    int fastest_particle() const { return fastest_particle_; }
    /// The first particle of an obstacle that the last substep gave no finite impulse: its water has none either.
    std::optional<int> first_not_finite() const;

private:
    void begin(double h);
    void sum_forces(const std::vector<Eigen::Vector3d>& given, double h);
    std::unique_ptr<Water> make_water() const;

    const Model& model_;
    int threads_;
    std::optional<int> gpu_;
    std::vector<double> spacing_;    ///< of bodies' particles, which come first; obstacles' have none
    std::vector<double> displaced_;  ///< mass of water in place of these
    Immersed immersed_;
    std::vector<std::vector<Cube>> obstacles_;  ///< of each its cubes
    std::unique_ptr<Water> water_;
    std::vector<Push> pushes_;
    std::vector<Eigen::Vector3d> impulses_, places_, velocities_;
    std::vector<Eigen::Vector3d> forces_;  ///< sums of impulses, by particle of the Model
    double force_time_ = 0;                ///< in which these were given, s
    double time_ = 0;
    double step_ = 0;  ///< the last one, s
    double fastest_ = 0;
    int fastest_particle_ = 0;
};

extern template class Coupling<float>;
extern template class Coupling<double>;

}  // namespace natator::lattice
