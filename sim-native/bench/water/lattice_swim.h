#pragma once

#include <memory>
#include <optional>

#include "solver/lattice/immersed.h"
#include "solver/lattice/water.h"
#include "water/swim.h"

namespace natator::bench {

/// A swimmer in water on a lattice, in a box with walls without friction. Its particles are a cell apart, at least one
/// across, in an even or odd number as fits its width. A frame is a step.
class LatticeSwim {
public:
    /// `scene.box`: one cell high if the swimmer is a slab. `mach`: of 1.2 lengths a beat, which is about what a tail
    /// does.
    LatticeSwim(const Swimmer& swimmer, const SwimScene& scene, int resolution, double mach, std::optional<int> gpu);

    const SwimBody& body() const { return *body_; }
    double spacing() const { return box_.cell; }  ///< a cell of water has mass 1
    /// False if something is not finite.
    bool frame();
    /// Of the last frame's force on the body along x what acts along the surface's normal, mass length/s^2: by the
    /// outline's, which goes with the body as its places do.
    double pressure() const { return pressure_; }
    WaterRun run() const { return run_; }  ///< its particles: the lattice's cells

private:
    lattice::Box box_;
    double step_;  ///< s
    std::unique_ptr<lattice::Water> water_;
    std::optional<lattice::Immersed> immersed_;
    std::optional<SwimBody> body_;
    std::vector<Eigen::Vector3d> normals_;  ///< of the straight body
    double pressure_ = 0;
    std::vector<lattice::Push> pushes_;
    WaterRun run_;
};

}  // namespace natator::bench
