#include "evaluate_large.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

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

/// Evaluates as many members at a time as there are States side by side.
template <class Real>
class LargeScene {
public:
    LargeScene(const Scene& scene, const Model& model, int states, BatchTimes* times)
        : scene_(scene), model_(model), times_(times), runner_(model, states) {}

    /// At most as many as there are States.
    void evaluate(const BatchMember* members, int count, std::vector<Evaluation>& evaluations) {
        progress_.assign(runner_.states(), Progress{});
        start(members, count);
        const std::vector<Progress> settled = progress_;
        typename Runner::Update update{0, scene_.time_step, model_.parameters.substeps, {}, false};
        for (int k = 0; k < runner_.states(); ++k) update.gaits.push_back(&members[std::min(k, count - 1)].gait);
        runner_.prepare(update);
        path_.assign(runner_.states(), {});
        tail_.assign(runner_.states(), {});
        const std::vector<typename Runner::Place> begin = runner_.places();
        for (int k = 0; k < runner_.states(); ++k) {
            path_[k].push_back(begin[k].mean_x);
            tail_[k].push_back(begin[k].tail_z);
        }
        const HostClock watch;
        const auto frames = static_cast<int>(std::lround(scene_.duration / scene_.time_step));
        for (int frame = 0; frame < frames && let_rest(count); ++frame) {
            update.start_time = frame * scene_.time_step;
            note(runner_.run(update, times_ ? times_->profile : nullptr), update);
        }
        if (times_) times_->kernel += watch.seconds();
        const std::vector<Real> densities = runner_.densities();
        const std::size_t fluid = runner_.model().view().fluid;
        for (int k = 0; k < count; ++k) {
            const auto own = densities.begin() + static_cast<std::ptrdiff_t>(densities.empty() ? 0 : k * fluid);
            evaluations.push_back(evaluation_of(
                scene_, model_, runner_.model().particle_of(), progress_[k],
                settled[k].stopped >= 0 ? nullptr : &members[k].gait, path_[k].data(), tail_[k],
                runner_.download(k, initial_state<Real>(model_)),
                std::vector<Real>(own, own + static_cast<std::ptrdiff_t>(densities.empty() ? 0 : fluid))));
        }
    }

private:
    using Runner = LargeRunner<Real>;

    /// Takes the members to their settled starts; those without a perturbation share one.
    void start(const BatchMember* members, int count) {
        const auto is_perturbed = [](const BatchMember& member) { return member.perturbation.amplitude != 0; };
        const bool alike = std::none_of(members, members + count, is_perturbed);
        if (!alike || !shared_start_) {
            for (int k = 0; k < runner_.states(); ++k) {
                Model own = model_;
                perturb(members[std::min(k, count - 1)].perturbation, own);
                runner_.upload(k, initial_state<Real>(own));
            }
            settle(alike ? 1 : count);
        }
        if (!alike) return;
        if (!shared_start_) shared_start_ = {runner_.download(0, initial_state<Real>(model_)), progress_[0]};
        for (int k = 0; k < runner_.states(); ++k) {
            runner_.upload(k, shared_start_->first);
            progress_[k] = shared_start_->second;
        }
    }

    void settle(int count) {
        const HostClock watch;
        const Settling& settling = scene_.settling;
        const typename Runner::Update update{0, settling.time_step, settling.substeps, {}, true};
        for (int k = 0; k < settling.updates && let_rest(count); ++k) {
            const auto ends = runner_.run(update);
            for (int state = 0; state < runner_.states(); ++state)
                if (progress_[state].stopped < 0) note_instability(ends[state], update, progress_[state]);
        }
        if (times_) times_->settling += watch.seconds();
    }

    /// What has stopped, and States without a member, stay as they are. False if all do.
    bool let_rest(int count) {
        std::vector<bool> idle(runner_.states(), true);
        bool any = false;
        for (int k = 0; k < count; ++k) {
            idle[k] = progress_[k].stopped >= 0;
            any |= !idle[k];
        }
        if (idle != idle_) runner_.set_idle(idle);
        idle_ = idle;
        return any;
    }

    void note(const std::vector<typename Runner::End>& ends, const typename Runner::Update& update) {
        const bool swims = !model_.body.particles.empty();
        const long window = swims ? std::lround(scene_.stopping.no_progress_after / scene_.time_step) : 0;
        for (int k = 0; k < runner_.states(); ++k) {
            Progress& progress = progress_[k];
            if (idle_[k] || note_instability(ends[k], update, progress)) continue;
            path_[k].push_back(ends[k].mean_x);
            tail_[k].push_back(ends[k].tail_z);
            progress.muscle_work += ends[k].muscle_work;
            ++progress.frames;
            if (scene_.stopping.plane_contact && ends[k].touches_plane)
                progress.stopped = static_cast<int>(StopReason::touched_plane);
            else if (physics::without_progress(path_[k].data(), progress.frames, window))
                progress.stopped = static_cast<int>(StopReason::no_progress);
        }
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
    std::vector<Progress> progress_;
    std::vector<std::vector<double>> path_, tail_;  ///< mean x of the body, mean z of its last slice
    std::vector<bool> idle_;
    std::optional<std::pair<State<Real>, Progress>> shared_start_;
};

/// So many fill a GPU; more at a time only take more memory.
constexpr int particles_at_a_time = 1'000'000;

/// At most so many at a time, in parts of the same size as far as they go.
template <class Real>
std::vector<Evaluation> evaluate_in_parts(const Scene& scene, const Model& model,
                                          const std::vector<BatchMember>& members, int most, BatchTimes* times) {
    const int all = static_cast<int>(members.size());
    const int parts = (all + most - 1) / most, states = (all + parts - 1) / parts;
    LargeScene<Real> large(scene, model, states, times);
    std::vector<Evaluation> evaluations;
    for (int first = 0; first < all; first += states)
        large.evaluate(members.data() + first, std::min(states, all - first), evaluations);
    return evaluations;
}

}  // namespace

template <class Real>
std::vector<Evaluation> evaluate_large(const Scene& scene, const Model& model, const std::vector<BatchMember>& members,
                                       BatchTimes* times) {
    const int all = static_cast<int>(members.size());
    int most = std::min(all, particles_at_a_time / model.particles() + 1);
    for (;;) {
        try {
            return evaluate_in_parts<Real>(scene, model, members, most, times);
        } catch (const std::bad_alloc&) {
            if (most == 1) throw;
            most = (most + 1) / 2;
        }
    }
}

template std::vector<Evaluation> evaluate_large<float>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                       BatchTimes*);
template std::vector<Evaluation> evaluate_large<double>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                        BatchTimes*);

}  // namespace natator::cuda
