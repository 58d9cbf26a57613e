#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "natator/model.h"
#include "water.h"

namespace natator::lattice {

/// A substep: a Mach number of 0.5. Well below it water is as good as incompressible; above 1 it is nothing.
constexpr double max_cells_per_substep = 0.3;

/// What of a Model of scheme `lattice` is in its water.
class CoupledBodies {
public:
    explicit CoupledBodies(const Model& model);

    /// The bodies' particles, which come first among the Model's.
    const Immersed& immersed() const { return immersed_; }
    /// Mass of the water in place of each of them.
    const std::vector<double>& displaced() const { return displaced_; }
    /// Of what a particle's last impulse counts in the running mean, see Coupling; the present one counts 1.
    double kept(int particle) const { return kept_[particle]; }
    /// Of all obstacles, one behind the other, and how many each has.
    const std::vector<Cube>& obstacle_cubes() const { return obstacle_cubes_; }
    const std::vector<std::size_t>& cubes_of_obstacles() const { return cubes_of_obstacles_; }
    int cubes() const { return static_cast<int>(spacing_.size() + obstacle_cubes_.size()); }  ///< of all

private:
    std::vector<double> spacing_, displaced_, kept_;
    Immersed immersed_;
    std::vector<Cube> obstacle_cubes_;
    std::vector<std::size_t> cubes_of_obstacles_;
};

Eigen::Vector3i whole_cells(const Eigen::Vector3d& length, const Box& box);

/// All that goes from one substep to the next beside the water.
struct Exchange {
    std::vector<Eigen::Vector3d> impulses;  ///< by particle, mass length/s: running means
    double time = 0;                        ///< s, at the last substep's end
    double step = 0;                        ///< the last one, s
    double fastest = 0;                     ///< the greatest speed of a particle in a substep so far, cells
    int fastest_particle = 0;

    /// Writes it, then the water. Null: nothing of either.
    void save(ByteWriter& to, const Water* water) const;
    /// Takes what `save` wrote. `make`: gives the water, a new one if there is none. Throws InputError when it is not
    /// of so many particles, and then nothing has changed. False if there was nothing.
    bool restore(ByteReader from, int particles, const std::function<Water&()>& make);
};

/// All cells of the water after steps of so long, s; at rest without.
WaterField field_of(const Box& box, const Water* water, double step);

/// What an obstacle is given is shared evenly by its particles: mean forces, of sums by cube.
template <class Real>
std::vector<Vector3<Real>> mean_forces(const Model& model, const CoupledBodies& bodies,
                                       const std::vector<Eigen::Vector3d>& sums, double time);

/// The water of a Model of scheme `lattice` on the CPU and the particles in it, substep by substep: a substep is a step
/// of the water. What the water gives a particle comes to it as a running mean, half of it at once, or less of a
/// particle smaller than two cells or lighter than its water: all at once, particles of two cells swing ever more from
/// step to step (free particles, measured: 1.02 times). Nothing of it is lost. At first, and wherever a State's time
/// does not go on from where the last one ended, all water goes with the box' current.
template <class Real>
class Coupling {
public:
    Coupling(const Model& model, int threads) : model_(model), threads_(threads), bodies_(model) {}

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
    /// See Solver::visit_lattice_cells.
    void visit_cells(const std::function<void(double, const Eigen::Vector3d&)>& visit) const;
    /// Begins to sum what the water does to the particles, see Solver::forces.
    void clear_forces();
    std::vector<Vector3<Real>> forces() const;
    /// The greatest speed of a particle in a substep so far, cells.
    double fastest() const { return exchange_.fastest; }
    int fastest_particle() const { return exchange_.fastest_particle; }
    /// The first particle of an obstacle that the last substep gave no finite impulse: its water has none either.
    std::optional<int> first_not_finite() const;

private:
    void begin(double h);

    const Model& model_;
    int threads_;
    CoupledBodies bodies_;
    std::unique_ptr<Water> water_;
    Exchange exchange_;
    std::vector<Push> pushes_;
    std::vector<Eigen::Vector3d> places_, velocities_;
    std::vector<Eigen::Vector3d> forces_;  ///< sums of impulses, by cube
    double force_time_ = 0;                ///< in which these were given, s
};

extern template class Coupling<float>;
extern template class Coupling<double>;

}  // namespace natator::lattice
