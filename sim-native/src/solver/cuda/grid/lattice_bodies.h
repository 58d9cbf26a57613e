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
    virtual void launch_upload(const GridLaunch<Real>& launch) const = 0;
    virtual void launch_download(const GridLaunch<Real>& launch) const = 0;
    /// Before a substep of the bodies: gives them what the water gave them, and their weight in it; behind it: the
    /// water's step.
    virtual void launch_push(const GridLaunch<Real>& launch) const = 0;
    virtual void launch_follow(const GridLaunch<Real>& launch) const = 0;
    /// To be called before an update and behind it: where uploads take from, and downloads put, what the waters are.
    virtual void stage() = 0;
    virtual void take_back() = 0;
};

}  // namespace natator::cuda
