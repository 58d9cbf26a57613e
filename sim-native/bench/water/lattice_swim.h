#pragma once

#include <memory>
#include <optional>

#include "solver/lattice/immersed.h"
#include "solver/lattice/water.h"
#include "water/swim.h"

namespace natator::bench {

/// A swimmer in water on a lattice, in a box with walls without friction. Its particles are a cell apart, at least one across, in an even or
/// odd number as fits its width. A frame is a step.
class LatticeSwim {
public:
    /// `scene.box`: one cell high if the swimmer is a slab. `mach`: of 1.2 lengths a beat, which is about what a tail does.
    LatticeSwim(const Swimmer& swimmer, const SwimScene& scene, int resolution, double mach, std::optional<int> gpu);

    const SwimBody& body() const { return *body_; }
    double spacing() const { return box_.cell; }  ///< a cell of water has mass 1
    /// False if something is not finite.
    bool frame();
    WaterRun run() const { return run_; }  ///< its particles: the lattice's cells

private:
    lattice::Box box_;
    double step_;  ///< s
    std::unique_ptr<lattice::Water> water_;
    std::optional<lattice::Immersed> immersed_;
    std::optional<SwimBody> body_;
    std::vector<lattice::Push> pushes_;
    WaterRun run_;
};

}  // namespace natator::bench
