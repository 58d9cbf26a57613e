#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// Where a body feels the water: the particles of a slice that lie outermost on one of its sides at rest.
struct SkinPlace {
    enum class Side { left, right, above, below };

    int slice = 0;  ///< 0 = head
    Side side = Side::left;
};

/// What a swimmer is asked for beside its own pose.
struct Sensing {
    std::vector<SkinPlace> flow{};  ///< 1000 at most
    /// Distance from a place up to which water counts, length; 0: solid_rest_distance + 2 fluid_rest_distance.
    double within = 0;
    std::optional<Eigen::Vector3d> target{};  ///< where it shall go, length over ground
};

/// Throws InputError unless the scene has a body, each place is on it, and `within` is 0 or a length up to 1000.
void check_sensing(const Sensing& sensing, const Model& model);

/// The water about a place of the skin.
struct SkinFlow {
    /// Velocity of the water less that of the place, along the body's own axes, length/s: mean over the fluid particles
    /// within the distance s that is asked for, weighted by (1 - (r/s)^2)^3. 0 without any.
    Eigen::Vector3d velocity{0, 0, 0};
    int particles = 0;  ///< number of fluid particles that it is a mean over
};

/// What a swimmer knows of itself and of the water. "Own axes" are forward, up and right of its body.
struct Senses {
    Eigen::Vector3d centre{0, 0, 0};  ///< mean of the body's particles, length over ground
    /// Own axes as columns: forward, up, right, each of length 1. Those of the rotation of all particles that fits best
    /// (Umeyama 1991), so that bends to both sides do not count.
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    /// Velocity of the centre of mass, along own axes, length/s; in a moving tank less its current.
    Eigen::Vector3d velocity{0, 0, 0};
    Eigen::Vector3d turn_rate{0, 0, 0};  ///< angular velocity about own axes, rad/s: angular momentum over inertia
    /// How each actuator's muscles are contracted, in units of its drive: what drive would ask for the lengths that they
    /// have, in the mean over them.
    std::vector<double> bend;
    std::vector<SkinFlow> flow;  ///< one for each place of Sensing::flow
    std::optional<Eigen::Vector3d> target;  ///< direction from the centre, along own axes, of length 1; 0 where it is there
    double target_distance = 0;             ///< from the centre, length
};

/// Reads them off a state. `sensing` must fit the model (check_sensing). Throws InputError if the state has not as many particles
/// as the model. Real is float or double.
template <class Real>
Senses sense(const Model& model, const State<Real>& state, const Sensing& sensing);

extern template Senses sense(const Model&, const State<float>&, const Sensing&);
extern template Senses sense(const Model&, const State<double>&, const Sensing&);

}  // namespace natator
