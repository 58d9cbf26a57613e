#include "goals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/text.h"
#include "natator/error.h"

namespace natator {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
using Measure = Goal::Measure;

[[noreturn]] void refuse(const Scene& scene, std::size_t goal, const std::string& what) {
    throw InputError("scene " + quoted(scene.name) + ": goals[" + std::to_string(goal) + "]: " + what);
}

/// A place that the body is sent to must lie in the tank, as far as that stands still, and below the water's surface.
void check_place(const Scene& scene, const Model& model, std::size_t number, const Eigen::Vector3d& way) {
    const Eigen::Vector3d there = rest_centre(model) + way;
    std::ostringstream text;
    text << "its place, (" << computed_text(there.x()) << ", " << computed_text(there.y()) << ", "
         << computed_text(there.z()) << "), ";
    for (std::size_t k = 0; k < scene.planes.size(); ++k) {
        const Plane& plane = scene.planes[k];
        const bool upright = std::abs(plane.normal.y()) < 0.5;
        if (scene.moving_tank && upright && (scene.moving_tank->along_z || std::abs(plane.normal.x()) > 0.5)) continue;
        if (plane.distance(there) > 0) continue;
        text << "lies beyond planes[" << k << "]; must be inside the tank";
        refuse(scene, number, text.str());
    }
    if (!scene.fluid) return;
    const double surface = scene.fluid->origin.y() + (scene.fluid->count.y() - 0.5) * scene.fluid->spacing;
    if (way.y() != 0 && there.y() > surface) {
        text << "lies above the water, which ends at y = " << computed_text(surface);
        refuse(scene, number, text.str());
    }
}

}  // namespace

GoalRecord::GoalRecord(const Scene& scene, const Model& model)
    : goals_(scene.goals), progress_(scene.goals.size()), duration_(scene.duration), body_length_(model.body.length) {
    if (goals_.empty()) return;
    if (model.body.particles.size() < 3) refuse(scene, 0, "needs a creature of at least 3 particles");
    for (const int i : model.body.particles) body_mass_ += model.inverse_mass[i] > 0 ? 1 / model.inverse_mass[i] : 0;
    for (std::size_t k = 0; k < goals_.size(); ++k) {
        const Goal& goal = goals_[k];
        if (goal.measure == Measure::depth) check_place(scene, model, k, {0, goal.amount, 0});
        if (goal.measure == Measure::reach) check_place(scene, model, k, goal.place);
        if (goal.measure == Measure::economy && (model.scheme == Scheme::flex || model.muscles.empty()))
            refuse(scene, k, "economy needs the work of muscles: a creature with joints, in scheme conserving or lattice");
    }
}

double GoalRecord::left_to_go(const Goal& goal, const Pose& pose) const {
    switch (goal.measure) {
        case Measure::turn: return std::abs(goal.amount - turned_ * degrees);
        case Measure::depth: return std::abs(start_.centre.y() + goal.amount - pose.centre.y());
        case Measure::reach: return (start_.centre + goal.place - pose.centre).norm();
        default: return 0;
    }
}

void GoalRecord::start(const Pose& pose) {
    start_ = pose;
    last_yaw_ = pose.yaw;
    for (std::size_t k = 0; k < goals_.size(); ++k) progress_[k].at_start = progress_[k].left = left_to_go(goals_[k], pose);
}

bool GoalRecord::add(const Pose& pose, double time) {
    ++frames_;
    turned_ += std::remainder(pose.yaw - last_yaw_, 2 * std::numbers::pi);
    last_yaw_ = pose.yaw;
    bool over = false;
    for (std::size_t k = 0; k < goals_.size(); ++k) {
        const Goal& goal = goals_[k];
        Progress& progress = progress_[k];
        progress.left = left_to_go(goal, pose);
        progress.away += (pose.centre - start_.centre).norm();
        if (!goal.arrives() || progress.arrived_at || progress.left > goal.within) continue;
        progress.arrived_at = time;
        over |= goal.stop;
    }
    return over;
}

std::vector<GoalResult> GoalRecord::results(double distance, double forward, std::optional<double> work) const {
    std::vector<GoalResult> results;
    for (std::size_t k = 0; k < goals_.size(); ++k) {
        const Goal& goal = goals_[k];
        const Progress& progress = progress_[k];
        GoalResult result{goal.measure, goal.weight, 0, {}, {}};
        if (goal.arrives()) {
            result.left = progress.left;
            result.arrived_at = progress.arrived_at;
            result.score = progress.arrived_at ? std::max(1.0, 2 - *progress.arrived_at / duration_)
                                               : 1 - progress.left / progress.at_start;
        } else if (goal.measure == Measure::hold) {
            result.score = frames_ > 0 ? 1 / (1 + progress.away / frames_ / body_length_) : 1;
        } else if (goal.measure == Measure::economy) {
            result.score = work && *work > 0 ? distance * body_mass_ / *work : 0;
        } else {
            result.score = goal.measure == Measure::forward ? forward : distance;
        }
        results.push_back(result);
    }
    return results;
}

}  // namespace natator
