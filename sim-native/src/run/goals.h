#pragma once

#include <optional>
#include <vector>

#include "natator/measure.h"
#include "natator/scene.h"

namespace natator {

/// Follows how far a body's goals are met, frame by frame.
class GoalRecord {
public:
    /// Throws InputError when a goal can't be asked of this scene.
    GoalRecord(const Scene& scene, const Model& model);

    bool empty() const { return goals_.empty(); }
    /// The pose at time 0.
    void start(const Pose& pose);
    /// The pose at the end of a frame. True if a goal that ends the run has been arrived at.
    bool add(const Pose& pose, double time);
    /// Scores at the end; `distance` and `forward` of the whole way, `work` of the muscles where it is known.
    std::vector<GoalResult> results(double distance, double forward, std::optional<double> work) const;

private:
    struct Progress {
        double at_start = 0, left = 0;
        double away = 0;  ///< sum over frames of the distance from the start
        std::optional<double> arrived_at;
    };
    double remaining(const Goal& goal, const Pose& pose) const;

    std::vector<Goal> goals_;
    std::vector<Progress> progress_;
    double duration_, body_length_, body_mass_ = 0;
    Pose start_;
    double last_yaw_ = 0, turned_ = 0;  ///< the latter grows beyond half a turn, rad
    int frames_ = 0;
};

}  // namespace natator
