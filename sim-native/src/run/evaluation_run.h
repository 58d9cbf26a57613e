#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "natator/evaluate.h"
#include "physics/laws.h"
#include "run/laws.h"
#include "swim_record.h"

namespace natator {

/// What a run has come to by the end of a frame, or at its start.
struct FrameEnd {
    std::optional<Instability> instability{};  ///< what is not finite; then the rest means nothing
    physics::LawMeasures laws{};
    double cells_per_step = 0;  ///< Solver::cells_per_step
    std::vector<double>
        work{};  ///< of the muscles since the start by swimmer (Solver::muscle_works), mass length^2/s^2
    SwimRecord::Frame frame{};
};

/// A run of a scene as an evaluation follows it, whatever advances it: what ends it, and what it is worth.
class EvaluationRun {
public:
    /// `laws`: of the start, with muscles at rest. What it is given but these must live as long as this.
    EvaluationRun(const Scene& scene, const Model& model, const Gait& gait, LawWatch laws);

    void start(const FrameEnd& start);
    void add(const FrameEnd& end);
    /// All frames at once, where the decisions were made elsewhere. `path`: the body's mean x at the start and after
    /// each.
    void take(const double* path, int frames, StopReason stopped, const std::optional<Instability>& instability);

    bool is_over() const { return result_.instability || result_.stopped != StopReason::completed; }
    bool needs_body() const { return record_.needs_body(); }
    /// Frames that did not end unstable.
    int frames() const { return result_.frames; }
    std::optional<Instability>& instability() { return result_.instability; }
    Eigen::Vector3d origin() const { return record_.origin(); }

    bool tank_is_due() const { return record_.tank_is_due(); }
    template <class Real>
    void move_tank(State<Real>& state) {
        record_.move_tank(state);
        laws_.restart();
    }

    /// Its result. `densities`: of all particles, in units of rest density.
    template <class Real>
    Evaluation finish(const State<Real>& begin, const State<Real>& end, const std::vector<Real>& densities);

private:
    const Scene& scene_;
    const Model& model_;
    const Gait& gait_;
    LawWatch laws_;
    SwimRecord record_;
    double work_ = 0;  ///< of the swimmer's own muscles
    Evaluation result_;
};

/// Of an evaluation.
inline int frames_of(const Scene& scene) {
    return static_cast<int>(std::lround(scene.duration / scene.time_step));
}

/// Advances runs of a scene side by side, frame by frame, until each is over or has its duration. `stepper` is a
/// backend:
///   FrameEnds start();                                         by run, before the first frame
///   FrameEnds frame(int number, const std::vector<bool>& over);  those that are over stay as they are
///   void record_frame(std::size_t run, EvaluationRun& its);           its start, or a frame of it, has been noted and
///   is stable
template <class Stepper>
void run_frames(const Scene& scene, Stepper& stepper, std::vector<EvaluationRun>& runs) {
    const auto note = [&](const std::vector<FrameEnd>& ends, const std::vector<bool>& over, auto add) {
        for (std::size_t k = 0; k < runs.size(); ++k) {
            if (over[k]) continue;
            (runs[k].*add)(ends[k]);
            if (!runs[k].instability()) stepper.record_frame(k, runs[k]);
        }
    };
    std::vector<bool> over(runs.size(), false);
    note(stepper.start(), over, &EvaluationRun::start);
    for (int frame = 0; frame < frames_of(scene); ++frame) {
        for (std::size_t k = 0; k < runs.size(); ++k) over[k] = runs[k].is_over();
        if (std::find(over.begin(), over.end(), false) == over.end()) return;
        note(stepper.frame(frame, over), over, &EvaluationRun::add);
    }
}

}  // namespace natator
