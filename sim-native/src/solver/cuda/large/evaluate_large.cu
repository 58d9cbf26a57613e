#include "evaluate_large.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <mutex>

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

/// The settled start that members without a perturbation share, by who asks first.
template <class Real>
struct SharedStart {
    std::mutex mutex;
    std::optional<State<Real>> state;
    Progress progress;
};

/// Evaluates one member after another. Several work side by side, each with a stream of its own: a State of some
/// thousand particles leaves most of a GPU idle.
template <class Real>
class LargeScene {
public:
    LargeScene(const Scene& scene, const Model& model, SharedStart<Real>& shared, StageProfile* profile)
        : scene_(scene), model_(model), shared_(shared), profile_(profile), runner_(model) {}

    Evaluation evaluate(const BatchMember& member) {
        const Progress settled = start(member.perturbation);
        Progress progress = settled;
        runner_.prepare(update_of(member.gait, progress));
        std::vector<double> path{runner_.mean_x()};
        const HostClock watch;
        const auto frames = static_cast<int>(std::lround(scene_.duration / scene_.time_step));
        while (progress.stopped < 0 && progress.frames < frames) advance(member.gait, progress, path);
        times_.kernel += watch.seconds();
        const State<Real> end = runner_.download(initial_state<Real>(model_));
        return evaluation_of(scene_, model_, runner_.model().particle_of(), progress,
                             settled.stopped >= 0 ? nullptr : &member.gait, path.data(), end, runner_.densities());
    }

    /// Spent so far.
    const BatchTimes& times() const { return times_; }

private:
    using Runner = LargeRunner<Real>;

    Progress start(const Perturbation& perturbation) {
        if (perturbation.amplitude != 0) {
            Model perturbed = model_;
            perturb(perturbation, perturbed);
            return settle(initial_state<Real>(perturbed));
        }
        const std::lock_guard lock(shared_.mutex);
        if (!shared_.state) {
            shared_.progress = settle(initial_state<Real>(model_));
            shared_.state = runner_.download(initial_state<Real>(model_));
        }
        runner_.upload(*shared_.state);
        return shared_.progress;
    }

    Progress settle(const State<Real>& state) {
        runner_.upload(state);
        const HostClock watch;
        const Settling& settling = scene_.settling;
        const typename Runner::Update update{0, settling.time_step, settling.substeps, nullptr, true};
        Progress progress;
        for (int k = 0; k < settling.updates && progress.stopped < 0; ++k)
            note_instability(runner_.run(update), update, progress);
        times_.settling += watch.seconds();
        return progress;
    }

    typename Runner::Update update_of(const Gait& gait, const Progress& progress) const {
        return {progress.frames * scene_.time_step, scene_.time_step, scene_.solver.substeps, &gait, false};
    }

    void advance(const Gait& gait, Progress& progress, std::vector<double>& path) {
        const typename Runner::Update update = update_of(gait, progress);
        const typename Runner::End end = runner_.run(update, profile_);
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
    SharedStart<Real>& shared_;
    StageProfile* profile_;
    BatchTimes times_{};
    Runner runner_;
};

constexpr int most_side_by_side = 16;
constexpr int particles_that_fill_a_gpu = 200'000;

template <class Real>
int side_by_side(const Model& model, std::size_t members, const BatchTimes* times) {
    if (times && times->profile) return 1;  // stages are timed one by one
    const int fill = particles_that_fill_a_gpu / model.particles() + 1;
    return std::min({most_side_by_side, fill, static_cast<int>(members)});
}

}  // namespace

template <class Real>
std::vector<Evaluation> evaluate_large(const Scene& scene, const Model& model, const std::vector<BatchMember>& members,
                                       BatchTimes* times) {
    SharedStart<Real> shared;
    std::vector<Evaluation> evaluations(members.size());
    std::atomic<std::size_t> next = 0;
    int device = 0;
    check(cudaGetDevice(&device), "current device");
    const auto work = [&] {
        check(cudaSetDevice(device), "choose device");
        LargeScene<Real> large(scene, model, shared, times ? times->profile : nullptr);
        for (std::size_t k = next++; k < members.size(); k = next++) evaluations[k] = large.evaluate(members[k]);
        return large.times();
    };
    std::vector<std::future<BatchTimes>> workers;
    const int count = side_by_side<Real>(model, members.size(), times);
    for (int k = 0; k < count; ++k) workers.push_back(std::async(std::launch::async, work));
    for (auto& worker : workers) {
        const BatchTimes spent = worker.get();
        if (!times) continue;
        times->settling += spent.settling / count;  // side by side
        times->kernel += spent.kernel / count;
    }
    return evaluations;
}

template std::vector<Evaluation> evaluate_large<float>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                       BatchTimes*);
template std::vector<Evaluation> evaluate_large<double>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                        BatchTimes*);

}  // namespace natator::cuda
