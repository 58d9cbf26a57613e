#pragma once

#include <memory>

#include "natator/model.h"
#include "substep.cuh"

namespace natator::lattice {
struct WaterOnGpu;
}

namespace natator::cuda {

/// What bodies and their water on a lattice do to each other in the substeps of States side by side.
template <class Real>
class LatticeBodies {
public:
    /// Null of a Model without such water.
    static std::unique_ptr<LatticeBodies> of(const Model& model, int states);
    virtual ~LatticeBodies() = default;

    /// The water of State k in the next updates, whose bodies and room are of this Model; null: it has none, and stays
    /// as it is. Each update leaves there what it has come to.
    virtual void set_water(int k, lattice::WaterOnGpu* water) = 0;
    /// Asks for these on the stream of a launch: before the first substep of an update, and behind the last.
    virtual void launch_begin(const GridLaunch<Real>& launch) const = 0;
    virtual void launch_end(const GridLaunch<Real>& launch) const = 0;
    /// Before a substep of the bodies: gives them what the water gave them, and their weight in it; behind it: the
    /// water's step.
    virtual void launch_push(const GridLaunch<Real>& launch) const = 0;
    virtual void launch_follow(const GridLaunch<Real>& launch) const = 0;
    /// To be called between updates: hands what they begin with over to the device's side, and back.
    virtual void begin() = 0;
    virtual void end() = 0;
};

}  // namespace natator::cuda
