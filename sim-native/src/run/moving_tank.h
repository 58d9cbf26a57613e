#pragma once

#include <Eigen/Core>
#include <vector>

#include "natator/evaluate.h"
#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Keeps a tank about its swimmer. One for each run, in one thread at a time.
class MovingFrame {
public:
    /// Throws InputError unless the scene has water of scheme `conserving` or `lattice`, a creature, and for each
    /// axis that the tank moves along two planes across it with room enough between them.
    MovingFrame(const Scene& scene, const Model& model);

    /// A frame of `time` s has gone by: the current takes the tank along.
    void drift(double time) { origin_ += time * tank_.current; }
    /// Is the mean of the body's particles, in the tank's coordinates, a step from where it began?
    bool is_due(const Eigen::Vector3d& centre) const;
    /// Moves the tank if its swimmer has gone one step, and updates State::origin. `centre`: mean of the body's
    /// particles, length.
    template <class Real>
    void follow(const Eigen::Vector3d& centre, State<Real>& state);

    /// The tank goes on from here, `origin` as State::origin.
    void set_origin(const Eigen::Vector3d& origin) { origin_ = origin; }
    /// Where the tank's coordinates begin over ground, length: State::origin.
    const Eigen::Vector3d& origin() const { return origin_; }
    const WaterRenewal& renewal() const { return renewal_; }

private:
    /// An axis that the tank moves along, and the walls across it.
    struct Axis {
        int axis = 0;
        double low = 0, high = 0;
        double home = 0;  ///< place of the body's centre at the start, length
    };
    template <class Real>
    void move(const Axis& axis, int direction, State<Real>& state);

    const Model& model_;
    MovingTank tank_;
    std::vector<Axis> axes_;
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    WaterRenewal renewal_;
};

}  // namespace natator
