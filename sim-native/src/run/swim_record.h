#pragma once

#include <optional>
#include <vector>

#include "goals.h"
#include "moving_tank.h"
#include "natator/evaluate.h"

namespace natator {

/// What is noted of one run frame by frame, and when it is over: the same on CPU and GPU.
class SwimRecord {
public:
    /// What is read off a State after each frame, in the tank's coordinates.
    struct Frame {
        double mean_x = 0;
        double tail_z = 0;
        bool touches_plane = false;
        std::vector<Eigen::Vector3d> body{};  ///< of its particles, if `needs_body`
    };

    /// Throws InputError when the scene asks for what can't be.
    SwimRecord(const Scene& scene, const Model& model);

    /// Whether frames must come with the places of the body's particles.
    bool needs_body() const { return follower_ || !goals_.empty(); }
    void start(const Frame& frame);
    /// The run's next frame. Why it ends, if it does.
    std::optional<StopReason> add(const Frame& frame);
    /// Whether the tank is to be moved now: then `move_tank` must be called before the next frame.
    bool tank_is_due() const { return follower_ && follower_->is_due(centre_); }
    template <class Real>
    void move_tank(State<Real>& state) {
        follower_->follow(centre_, state);
    }

    int frames() const { return static_cast<int>(path_.size()) - 1; }
    /// By frame, the start first, over ground: mean x of the body, and mean z of its last slice.
    const std::vector<double>& path() const { return path_; }
    const std::vector<double>& tail() const { return tail_; }
    /// Where the tank's coordinates begin over ground; State::origin of a State that `move_tank` has not seen since.
    Eigen::Vector3d origin() const { return follower_ ? follower_->origin() : Eigen::Vector3d(0, 0, 0); }
    /// Adds what became of goals and of a moving tank to the figures of a stable run.
    void write_to(Evaluation& evaluation) const;

private:
    void note(const Frame& frame);

    const Scene& scene_;
    const Model& model_;
    long window_ = 0;  ///< frames without gain that end a run
    std::optional<MovingFrame> follower_;
    GoalRecord goals_;
    std::vector<double> path_, tail_;
    Pose pose_;                        ///< of the body, over ground
    Eigen::Vector3d centre_{0, 0, 0};  ///< of the body, in the tank
};

}  // namespace natator
