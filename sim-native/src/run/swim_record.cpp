#include "swim_record.h"

#include <cmath>

#include "physics/early_stop.h"

namespace natator {

SwimRecord::SwimRecord(const Scene& scene, const Model& model) : scene_(scene), model_(model), goals_(scene, model) {
    if (!model.body.particles.empty()) window_ = std::lround(scene.stopping.no_progress_after / scene.time_step);
    if (scene.moving_tank) follower_.emplace(scene, model);
}

/// Adds the frame to the paths over ground.
void SwimRecord::note(const Frame& frame) {
    path_.push_back(frame.mean_x + origin().x());
    tail_.push_back(frame.tail_z + origin().z());
    if (!needs_body()) return;
    centre_ = mean_place(frame.body);
    if (goals_.empty()) return;  // a tank follows the centre; the rotation takes a fit
    pose_ = pose_of(model_, model_.body, frame.body);
    pose_.centre += origin();
}

void SwimRecord::start(const Frame& frame) {
    note(frame);
    goals_.start(pose_);
}

std::optional<StopReason> SwimRecord::add(const Frame& frame) {
    if (follower_) follower_->drift(scene_.time_step);
    note(frame);
    const bool reached = !goals_.empty() && goals_.add(pose_, frames() * scene_.time_step);
    if (scene_.stopping.plane_contact && frame.touches_plane) return StopReason::touched_plane;
    if (reached) return StopReason::reached;
    if (physics::without_progress(path_.data(), frames(), window_)) return StopReason::no_progress;
    return std::nullopt;
}

void SwimRecord::write_to(Evaluation& evaluation) const {
    if (follower_) evaluation.renewal = follower_->renewal();
    const double forward = evaluation.course ? evaluation.course->forward : evaluation.distance;
    evaluation.goals = goals_.results(evaluation.distance, forward, evaluation.work);
}

}  // namespace natator
