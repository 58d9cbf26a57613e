#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "base/byte_reader.h"
#include "base/byte_writer.h"
#include "box.h"
#include "immersed.h"
#include "physics/lattice.h"

namespace natator::lattice {

/// A cell's water: density less that at rest, of that at rest; velocity, cells/step.
struct Cell {
    double excess = 0;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

/// A cell's populations, less those of water at rest.
struct Populations {
    float of[physics::lattice_populations];
};

/// Moments of a cell (physics/lattice.h) in equilibrium.
void equilibrium(const Cell& cell, float (&to)[17]);

/// In a step of so long, s.
physics::LatticeRates rates_in(const Box& box, double step);
/// What comes in at open ends in a step of so long, s.
Populations inflow(const Box& box, double step);

/// Water on a D3Q27 lattice, with bodies whose cells are told their velocity (physics/lattice.h).
///
/// A cell whose centre lies in a body moves as the body does there: after each collision its water has the body's
/// velocity. What streams in and out between its cells and the others pushes the body, which keeps its own mass and
/// momentum (by velocities against the body's: Wen, Zhang, Tu, Wang, Fang 2014). What a cell has more than the body
/// when it comes to lie in it goes to the body and to the water beside it, half each; cells that the body leaves go on
/// as water with its velocity: there are no fresh cells. No cell can give more than it holds, so a body needs no
/// implicit coupling, whatever its density. (Direct forcing in the whole volume: Fadlun, Verzicco, Orlandi, Mohd-Yusof
/// 2000; Uhlmann 2005.)
///
/// A body may widen as it bends, which the water in it must not resist: the divergence of its motion is added to the
/// density of its cells (Gazzola, Chatelain, van Rees, Koumoutsakos 2011, section 2).
class Water {
public:
    /// At rest, with open ends that let in water of the box' current.
    static std::unique_ptr<Water> on_cpu(const Box& box, int threads);
    /// The same. Throws NoDevice without that GPU or if this library was built without CUDA, std::bad_alloc if its
    /// memory is too small.
    static std::unique_ptr<Water> on_gpu(const Box& box, int device);
    virtual ~Water() = default;
    /// What one of so many cells takes at most on a CPU, whose steps one thread makes, or several.
    static double bytes_on_cpu(const Eigen::Vector3i& cells, bool several_threads);

    const Box& box() const { return box_; }
    /// Goes on by `step`, s, with the bodies where `cubes` says; `pushes`: what it gave each. The same bits for any
    /// number of threads.
    virtual void advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) = 0;
    /// Moves the water of each cell i to i - by; water that comes in is at rest.
    virtual void shift(const Eigen::Vector3i& by) = 0;

    virtual Cell cell(const Eigen::Vector3i& at) const = 0;
    /// Density over that at rest and velocity, cells/step, of all cells, x first, then y, then z.
    virtual std::vector<Eigen::Vector4f> cells() const = 0;
    virtual void set_cell(const Eigen::Vector3i& at, const Cell& cell) = 0;
    virtual void set_cells(const Cell& all) = 0;

    /// All that goes from one step to the next.
    virtual void save(ByteWriter& to) const = 0;
    /// Takes what `save` wrote, the last that there is to read. Throws InputError when it is not of such water in such
    /// a box, and then nothing has changed.
    virtual void restore(ByteReader from) = 0;

protected:
    explicit Water(const Box& box) : box_(box) {}
    [[noreturn]] static void refuse_saved() {
        throw InputError("state: its water is not of this lattice on this kind of processor");
    }
    Box box_;
};

}  // namespace natator::lattice
