#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "natator/gait.h"
#include "natator/measure.h"
#include "natator/simulation.h"

namespace natator::cli {

/// A network that was learned (sim-native/python/natator/policy.py): from what a swimmer senses to its next action, in
/// a closed loop. It acts every few frames, which the muscles follow linearly: by drives of the actuators, or by scales
/// and offsets of a gait.
class Policy {
public:
    /// Reads its JSON. Throws InputError.
    explicit Policy(const std::string& path);
    /// Throws InputError unless it has inputs and outputs for this body.
    void check(const Model& model) const;

    /// The gait that it scales and bends; none where it drives the actuators by itself.
    const std::optional<Gait>& gait() const { return gait_; }
    /// The place that it goes to at first, if it was learned with targets: the middle of their box.
    const std::optional<Eigen::Vector3d>& target() const { return sensing_.target; }
    /// Begins anew, with muscles at rest.
    void restart();
    /// For the next frame. Once the target is reached, another one is drawn from the box.
    template <class Real>
    Steering next(const Simulation<Real>& simulation, std::optional<Eigen::Vector3d>& target);

private:
    struct Layer {
        Eigen::MatrixXd weights;  ///< outputs × inputs
        Eigen::VectorXd bias;
    };

    template <class Real>
    Eigen::VectorXd inputs(const Simulation<Real>& simulation, const Senses& senses) const;

    std::vector<Layer> layers_;
    std::optional<Gait> gait_;
    Sensing sensing_;
    Eigen::Vector3d low_{0, 0, 0}, high_{0, 0, 0};  ///< of targets
    double reached_ = 0;                            ///< body lengths
    int frames_ = 1, frame_ = 0;                    ///< of an action, since the start
    Eigen::VectorXd before_, action_;
    std::mt19937 random_;
};

}  // namespace natator::cli
