#include <algorithm>
#include <new>

#include "base/side_by_side.h"
#include "evaluate_on_grid.h"
#include "evaluation.h"
#include "natator/batch.h"
#include "natator/model.h"
#include "natator/settled_state_cache.h"
#include "run/evaluate_frame_by_frame.h"
#include "run/laws.h"
#include "run/perturb.h"
#include "solver/cuda/device.h"
#include "solver/cuda/grid/parts.h"
#include "solver/cuda/kernel_choice.h"
#include "solver/cuda/refusal.h"
#include "solver/flex/cuda/batch_runner.h"
#include "solver/lattice/gpu_water.h"
#include "solver/law_name.h"
#include "uses_grid_kernels.h"

namespace natator {
namespace cuda {
namespace {

/// Evaluates batches of one scene on one device.
template <class Real>
class Batch {
public:
    Batch(const Scene& scene, const Model& model, const BatchOptions& options)
        : scene_(scene), model_(model), cache_(options.starts), times_(options.times), runner_(model), laws_(model) {}

    /// The members' evaluations, each of a State that starts settled.
    std::vector<Evaluation> evaluate(const std::vector<BatchMember>& members) {
        const Starts starts = settled_starts(members);
        DeviceStates<Real> states(runner_.model(), static_cast<int>(members.size()));
        states.copy_from(starts.states, starts.of_member);
        std::vector<Progress> progress;
        for (const int start : starts.of_member) progress.push_back(starts.progress[start]);
        return run(members, states, progress);
    }

private:
    using Copy = typename DeviceStates<Real>::Copy;
    struct Starts {
        DeviceStates<Real> states;
        std::vector<Progress> progress;
        std::vector<int> of_member;
    };

    /// Members without a perturbation share start 0.
    Starts settled_starts(const std::vector<BatchMember>& members) {
        std::vector<State<Real>> states{initial_state<Real>(model_)};
        std::vector<int> of_member;
        for (const BatchMember& member : members) {
            of_member.push_back(0);
            if (member.perturbation.amplitude == 0) continue;
            Model perturbed = model_;
            perturb(member.perturbation, perturbed);
            of_member.back() = static_cast<int>(states.size());
            states.push_back(initial_state<Real>(perturbed));
        }
        Starts starts{{runner_.model(), static_cast<int>(states.size())},
                      std::vector<Progress>(states.size()),
                      std::move(of_member)};
        starts.states.upload(states);
        const Settling& settling = scene_.settling;
        if (settling.updates == 0) return starts;
        const bool is_kept = cache_ && states.size() == 1;  // without a perturbation
        if (is_kept)
            if (const auto found = cache_->find<Real>(model_, settling, device_)) {
                starts.states.upload({*found});
                return starts;
            }
        BatchView<Real> batch = runner_.view_of(starts.states, settling.updates);
        batch.time_step = settling.time_step;
        batch.substeps = settling.substeps;
        batch.settling = true;
        const DeviceBuffer<physics::LawLimits> limits(std::vector<physics::LawLimits>(states.size(), laws_.limits()));
        batch.limits = limits.data();
        runner_.run(batch, starts.progress);
        if (times_) times_->settling += runner_.seconds();
        starts.progress = runner_.progress();
        if (is_kept && starts.progress.front().stopped < 0) {
            Copy settled(starts.states);
            settled.fetch();
            cache_->keep(model_, settling, settled.state(0, states.front()), device_);
        }
        return starts;
    }

    std::vector<Evaluation> run(const std::vector<BatchMember>& members, const DeviceStates<Real>& states,
                                const std::vector<Progress>& settled) {
        std::vector<double> frequency, power, amplitude, phase, offset;
        const bool steers =
            std::any_of(members.begin(), members.end(), [](const auto& m) { return !m.gait.offset.empty(); });
        for (const BatchMember& member : members) {
            frequency.push_back(member.gait.frequency);
            power.push_back(member.gait.power);
            amplitude.insert(amplitude.end(), member.gait.amplitude.begin(), member.gait.amplitude.end());
            phase.insert(phase.end(), member.gait.phase.begin(), member.gait.phase.end());
            std::vector<double> own = member.gait.offset;
            if (steers) own.resize(member.gait.amplitude.size(), 0);
            offset.insert(offset.end(), own.begin(), own.end());
        }
        const DeviceBuffer<double> frequencies(frequency), powers(power), amplitudes(amplitude), phases(phase),
            offsets(offset);
        const ModelView<Real>& view = runner_.model().view();
        DeviceBuffer<Real> density(static_cast<std::size_t>(states.count()) * view.fluid);
        density.clear();

        const int frames = frames_of(scene_);
        const bool swims = !model_.body.particles.empty();
        BatchView<Real> batch = runner_.view_of(states, frames);
        batch.time_step = scene_.time_step;
        batch.substeps = model_.parameters.substeps;
        batch.gait = {frequencies.data(), powers.data(), amplitudes.data(), phases.data(),
                      steers ? offsets.data() : nullptr};
        const DeviceBuffer<Real> lengths(supports_both(model_) ? muscle_lengths(members, frames) : std::vector<Real>{});
        if (supports_both(model_)) batch.muscle_length = lengths.data();
        batch.density = density.data();
        std::vector<physics::LawLimits> limits_of;
        for (const BatchMember& member : members) {
            LawWatch laws = laws_;
            laws.drive_by(member.gait);
            limits_of.push_back(laws.limits());
        }
        const DeviceBuffer<physics::LawLimits> limits(limits_of);
        batch.limits = limits.data();
        batch.stop_at_planes = scene_.stopping.plane_contact;
        batch.no_progress_frames =
            swims ? static_cast<int>(std::lround(scene_.stopping.no_progress_after / scene_.time_step)) : 0;
        std::optional<Copy> ends;
        HostBuffer<Real> densities;
        runner_.run(batch, settled, times_ ? times_->profile : nullptr, [&] {
            ends.emplace(states);
            densities = HostBuffer<Real>(density.size());
        });
        if (times_) {
            times_->kernel += runner_.seconds();
            times_->at_a_time = std::max(times_->at_a_time, states.count());
        }

        const std::vector<Progress> progress = runner_.progress();
        const std::vector<double> path = runner_.path();
        ends->fetch();
        densities.fetch(density);
        const State<Real> like = initial_state<Real>(model_), starts_of_nobody;  // companions are for the whole GPU
        std::vector<Evaluation> evaluations(members.size());
        side_by_side(members.size(), [&](std::size_t number) {
            const auto k = static_cast<int>(number);
            EvaluationRun run(scene_, model_, members[k].gait, laws_);
            take(run, progress[k], &path[number * (frames + 1)]);
            evaluations[k] =
                finish(run, scene_, model_, runner_.model().particle_of(), members[k].gait, settled[k].stopped < 0,
                       starts_of_nobody, ends->state(k, like), densities.data() + number * view.fluid, view.fluid);
        });
        return evaluations;
    }

    /// What the kernel has decided.
    static void take(EvaluationRun& run, const Progress& progress, const double* path) {
        const StopReason stopped =
            progress.stopped < 0 ? StopReason::completed : static_cast<StopReason>(progress.stopped);
        std::optional<Instability> found;
        if (stopped == StopReason::unstable) {
            const bool finite = progress.broken != physics::Law::finite;  // but against another law
            const char* const stage = !finite ? "velocities" : progress.frames > 0 ? "frame" : "settling";
            found = Instability{progress.bad_particle, stage, progress.bad_time, name(progress.broken)};
        }
        run.take(path, progress.frames, stopped, found);
    }

    /// Of the muscles, by member and frame, as the whole GPU has them.
    std::vector<Real> muscle_lengths(const std::vector<BatchMember>& members, int frames) const {
        const std::size_t muscles = model_.muscles.size(), of_member = frames * muscles;
        std::vector<Real> lengths(members.size() * of_member);
        side_by_side(members.size(), [&](std::size_t k) {
            State<Real> state;
            state.spring_rest_length.resize(model_.springs.size());
            Real* to = lengths.data() + k * of_member;
            for (int frame = 0; frame < frames; ++frame) {
                actuate(model_, members[k].gait, frame * scene_.time_step, state);
                for (const Muscle& muscle : model_.muscles) *to++ = state.spring_rest_length[muscle.spring];
            }
        });
        return lengths;
    }

    const Scene& scene_;
    const Model& model_;
    const SettledStateCache* cache_;
    std::string device_ = current_device_name() + " block ";
    BatchTimes* times_;
    BatchRunner<Real> runner_;
    LawWatch laws_;  ///< of the start, with muscles at rest
};

/// In halves where the whole does not fit into the device's memory.
std::vector<Evaluation> evaluate_in_parts(const EvaluateTogether& evaluate, const std::vector<BatchMember>& members) {
    try {
        return evaluate(members);
    } catch (const std::bad_alloc&) {
        if (members.size() < 2) throw;
    }
    const auto middle = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
    std::vector<Evaluation> all = evaluate_in_parts(evaluate, {members.begin(), middle});
    const std::vector<Evaluation> rest = evaluate_in_parts(evaluate, {middle, members.end()});
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

template <class Real>
std::vector<Evaluation> evaluate(const Scene& scene, const Model& model, const std::vector<BatchMember>& members,
                                 const BatchOptions& options) {
    if (uses_grid_kernels(scene, model, options)) return evaluate_on_grid<Real>(scene, model, members, options);
    Batch<Real> batch(scene, model, options);
    return evaluate_in_parts([&](const std::vector<BatchMember>& some) { return batch.evaluate(some); }, members);
}

/// Scheme `lattice`: some members at a time, by streams side by side, so that the host looks at some while the GPU goes
/// on with others.
std::vector<Evaluation> evaluate_in_lattices(const Scene& scene, const WaterBox& box,
                                             const std::vector<BatchMember>& members, const BatchOptions& options) {
    constexpr double usable = 0.9;  // beside the bodies
    constexpr int max_streams = 3;
    std::size_t free = 0, all = 0;
    check(cudaMemGetInfo(&free, &all), "memory");
    const double of_water = static_cast<double>(lattice::bytes_of_cell) * box.cells.cast<double>().prod(),
                 room = usable * static_cast<double>(free) / of_water;
    const int streams = static_cast<int>(std::clamp<double>(room, 1, max_streams));
    const Parts parts(static_cast<int>(members.size()), static_cast<int>(std::clamp(room / streams, 1.0, 1e6)),
                      streams);
    std::vector<Evaluation> evaluations(members.size());
    SharedGpu shared;
    EvaluationOptions how;
    how.precision = options.precision;
    how.execution.gpu = options.device;
    how.execution.shared = &shared;
    how.execution.starts = options.starts;
    side_by_side(
        parts.streams,
        [&](std::size_t stream) {
            for (int part = static_cast<int>(stream); part < parts.count; part += parts.streams) {
                const auto first = members.begin() + parts.first(part);
                const std::vector<Evaluation> some = evaluate_in_parts(
                    [&](const std::vector<BatchMember>& own) { return evaluate_frame_by_frame(scene, own, how); },
                    {first, first + parts.size_of(part)});
                std::copy(some.begin(), some.end(), evaluations.begin() + parts.first(part));
            }
        },
        max_streams, max_streams);
    return evaluations;
}

}  // namespace
}  // namespace cuda

std::vector<Evaluation> evaluate_on_gpu(const Scene& scene, const std::vector<BatchMember>& members,
                                        const BatchOptions& options) {
    for (const BatchMember& member : members) check_gait(member.gait, scene.creature ? scene.creature->actuators() : 0);
    cuda::choose_device(options.device);
    if (members.empty()) return {};
    const Model model = build_model(scene);
    if (const auto reason = cuda::refusal(model)) throw InputError("backend cuda: " + *reason);
    if (model.water_box) return cuda::evaluate_in_lattices(scene, *model.water_box, members, options);
    const cuda::DeviceMemory::Mark memory;
    const std::vector<Evaluation> evaluations = options.precision == Precision::double_precision
                                                    ? cuda::evaluate<double>(scene, model, members, options)
                                                    : cuda::evaluate<float>(scene, model, members, options);
    if (options.times) options.times->memory = std::max(options.times->memory, memory.peak());
    return evaluations;
}

}  // namespace natator
