#include "moving_tank.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/text.h"
#include "model/tank_ends.h"
#include "natator/error.h"
#include "natator/measure.h"

namespace natator {
namespace {

[[noreturn]] void refuse(const Scene& scene, const std::string& what) {
    throw InputError("scene " + quoted(scene.name) + ": movingTank: " + what);
}

/// Then there is no end that it would have to be kept from.
bool is_periodic(const Scene& scene, int axis) {
    return std::any_of(scene.periodic.begin(), scene.periodic.end(),
                       [axis](const PeriodicAxis& periodic) { return periodic.axis == axis; });
}

/// Where the two planes across an axis stand.
std::pair<double, double> walls_across(const Scene& scene, int axis) {
    const TankEnds ends = tank_ends(scene.planes, axis);
    if (!ends.one_each()) refuse(scene, "planes: " + one_each_needed(ends, axis));
    return {ends.low.front(), ends.high.front()};
}

}  // namespace

MovingFrame::MovingFrame(const Scene& scene, const Model& model) : model_(model), tank_(*scene.moving_tank) {
    if (scene.scheme == Scheme::flex) refuse(scene, "works in schemes conserving and lattice only");
    if (!scene.fluid) refuse(scene, "needs fluid");
    if (model.body.particles.empty()) refuse(scene, "needs a creature to follow");
    if (!scene.companions.empty() || !scene.obstacles.empty())
        refuse(scene, "has no room for companions and obstacles, which would be left behind");
    if (!scene.fluid->current.isZero(0))
        refuse(scene,
               "goes with its water: fluid.current must be [0, 0, 0]; over ground it may have a current of its own");
    if (model.water_box) {
        const double cells = tank_.step / model.water_box->cell;
        if (std::abs(cells - std::round(cells)) > 1e-3 || cells < 0.5)
            refuse(scene, "step = " + number_text(tank_.step) + ": must be a multiple of the cells' " +
                              number_text(model.water_box->cell) + " (fluid.spacing) in scheme lattice");
    }
    const Eigen::Vector3d centre = rest_centre(model);
    const double reach = model.body.length / 2 + tank_.step +
                         2 * model.parameters.conserving.kernel_support * model.parameters.fluid_rest_distance;
    for (const int axis : {0, 2}) {
        if ((axis == 2 && !tank_.along_z) || is_periodic(scene, axis)) continue;
        const auto [low, high] = walls_across(scene, axis);
        const double room = std::min(centre[axis] - low, high - centre[axis]);
        if (room < reach) {
            std::ostringstream text;
            text << "the body's centre is " << computed_text(room) << " from the nearer end of the tank along "
                 << name_of_axis(axis) << "; must be at least " << computed_text(reach)
                 << " (half the body, a step and two kernel radii)";
            refuse(scene, text.str());
        }
        axes_.push_back({axis, low, high, centre[axis]});
    }
}

bool MovingFrame::is_due(const Eigen::Vector3d& centre) const {
    for (const Axis& axis : axes_)
        if (std::abs(centre[axis.axis] - axis.home) >= tank_.step) return true;
    return false;
}

template <class Real>
void MovingFrame::follow(const Eigen::Vector3d& centre, State<Real>& state) {
    for (const Axis& axis : axes_) {
        const double ahead = centre[axis.axis] - axis.home;
        if (std::abs(ahead) >= tank_.step) move(axis, ahead > 0 ? 1 : -1, state);
    }
    state.origin = origin_;
}

/// Everything goes back by a step. Water that would then be beyond the wall behind comes to stand as far before the
/// wall in front: its layer at the one wall closes up with the layer that was at the other.
template <class Real>
void MovingFrame::move(const Axis& axis, int direction, State<Real>& state) {
    const int a = axis.axis;
    const Real step = static_cast<Real>(direction * tank_.step);
    const Real low = static_cast<Real>(axis.low), high = static_cast<Real>(axis.high), length = high - low;
    for (int i = 0; i < model_.particles(); ++i) {
        Real& x = state.position[i][a];
        x -= step;
        if (!model_.is_fluid(i)) continue;
        const bool behind = direction > 0 ? x < low : x > high;
        if (!behind) continue;
        x += direction > 0 ? length : -length;
        Vector3<Real>& velocity = state.velocity[i];
        const Eigen::Vector3d v = velocity.template cast<double>();
        const double mass = model_.inverse_mass[i] > 0 ? 1 / model_.inverse_mass[i] : 0;
        renewal_.momentum += mass * v;
        renewal_.kinetic_energy += mass * v.squaredNorm() / 2;
        ++renewal_.particles;
        velocity.setZero();
    }
    for (Vector3<Real>& centre : state.cluster_centre) centre[a] -= step;
    origin_[a] += direction * tank_.step;
    ++renewal_.times;
}

template void MovingFrame::follow(const Eigen::Vector3d&, State<float>&);
template void MovingFrame::follow(const Eigen::Vector3d&, State<double>&);

}  // namespace natator
