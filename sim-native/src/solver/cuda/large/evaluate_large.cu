#include "evaluate_large.h"

#include <chrono>
#include <cmath>

#include "evaluate/perturb.h"
#include "large_runner.h"
#include "physics/early_stop.h"
#include "solver/cuda/evaluation.h"

namespace natator::cuda {
namespace {

class HostClock {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

template <class Real>
class LargeScene {
public:
    LargeScene(const Scene& scene, const Model& model, BatchTimes* times)
        : scene_(scene), model_(model), times_(times), runner_(model) {}

    Evaluation evaluate(const BatchMember& member) {
        const Progress settled = start(member.perturbation);
        Progress progress = settled;
        runner_.prepare(update_of(member.gait, progress));
        std::vector<double> path{runner_.mean_x()};
        const HostClock watch;
        const auto frames = static_cast<int>(std::lround(scene_.duration / scene_.time_step));
        while (progress.stopped < 0 && progress.frames < frames) advance(member.gait, progress, path);
        if (times_) times_->kernel += watch.seconds();
        const State<Real> end = runner_.download(initial_state<Real>(model_));
        return evaluation_of(scene_, model_, runner_.model().particle_of(), progress,
                             settled.stopped >= 0 ? nullptr : &member.gait, path.data(), end, runner_.densities());
    }

private:
    using Runner = LargeRunner<Real>;

    /// Settles; members without a perturbation share their start.
    Progress start(const Perturbation& perturbation) {
        const bool shared = perturbation.amplitude == 0;
        if (shared && shared_start_) {
            runner_.restore_kept();
            return *shared_start_;
        }
        Model perturbed = model_;
        perturb(perturbation, perturbed);
        runner_.upload(initial_state<Real>(perturbed));
        const HostClock watch;
        const Settling& settling = scene_.settling;
        const typename Runner::Update update{0, settling.time_step, settling.substeps, nullptr, true};
        Progress progress;
        for (int k = 0; k < settling.updates && progress.stopped < 0; ++k)
            note_instability(runner_.run(update), update, progress);
        if (times_) times_->settling += watch.seconds();
        if (shared) {
            runner_.keep();
            shared_start_ = progress;
        }
        return progress;
    }

    typename Runner::Update update_of(const Gait& gait, const Progress& progress) const {
        return {progress.frames * scene_.time_step, scene_.time_step, scene_.solver.substeps, &gait, false};
    }

    void advance(const Gait& gait, Progress& progress, std::vector<double>& path) {
        const typename Runner::Update update = update_of(gait, progress);
        const typename Runner::End end = runner_.run(update, times_ ? times_->profile : nullptr);
        if (note_instability(end, update, progress)) return;
        path.push_back(end.mean_x);
        ++progress.frames;
        const bool swims = !model_.body.particles.empty();
        const long window = swims ? std::lround(scene_.stopping.no_progress_after / scene_.time_step) : 0;
        if (scene_.stopping.plane_contact && end.touches_plane)
            progress.stopped = static_cast<int>(StopReason::touched_plane);
        else if (physics::without_progress(path.data(), progress.frames, window))
            progress.stopped = static_cast<int>(StopReason::no_progress);
    }

    static bool note_instability(const typename Runner::End& end, const typename Runner::Update& update,
                                 Progress& progress) {
        if (end.finite) return false;
        progress.stopped = static_cast<int>(StopReason::unstable);
        progress.bad_particle = end.bad_particle;
        progress.bad_time = update.start_time + end.bad_substep * update.time_step / update.substeps;
        return true;
    }

    const Scene& scene_;
    const Model& model_;
    BatchTimes* times_;
    Runner runner_;
    std::optional<Progress> shared_start_;
};

}  // namespace

template <class Real>
std::vector<Evaluation> evaluate_large(const Scene& scene, const Model& model, const std::vector<BatchMember>& members,
                                       BatchTimes* times) {
    LargeScene<Real> large(scene, model, times);
    std::vector<Evaluation> evaluations;
    for (const BatchMember& member : members) evaluations.push_back(large.evaluate(member));
    return evaluations;
}

template std::vector<Evaluation> evaluate_large<float>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                       BatchTimes*);
template std::vector<Evaluation> evaluate_large<double>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                        BatchTimes*);

}  // namespace natator::cuda
