#include "evaluate_large.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <iterator>
#include <map>
#include <memory>
#include <tuple>

#include "evaluate/companions.h"
#include "evaluate/perturb.h"
#include "evaluate/swim_record.h"
#include "large_runner.h"
#include "natator/model_builder.h"
#include "parts.h"
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

using Points = std::vector<Eigen::Vector3d>;

/// Members whose Models differ in nothing but where their water begins.
struct Company {
    Model model;                     ///< what the device knows of all of them
    std::map<int, Points> begin;     ///< places of the particles, by arrangement
    std::vector<BatchMember> members{};
    std::vector<std::size_t> numbers{};  ///< of the members among all
};

int arrangement_of(const BatchMember& member, const Scene& scene) {
    return scene.fluid ? member.arrangement.value_or(scene.fluid->disorder) : 0;
}

/// Where a member begins, if places are the same.
using Start = std::tuple<int, double, std::uint64_t>;

Start start_of(const BatchMember& member, const Scene& scene) {
    const Perturbation& shift = member.perturbation;
    return {arrangement_of(member, scene), shift.amplitude, shift.amplitude == 0 ? 0 : shift.seed};
}

/// Evaluates as many members at a time as there are States side by side.
template <class Real>
class LargeScene {
public:
    LargeScene(const Scene& scene, const Company& company, int states, BatchTimes* times)
        : scene_(scene), company_(company), times_(times), runner_(company.model, states) {}

    /// Members from `first` on, at most as many as there are States.
    void evaluate(int first, int count, std::vector<Evaluation>& evaluations) {
        const BatchMember* const members = company_.members.data() + first;
        start(members, count);
        const std::vector<Progress> settled = progress_;
        typename Runner::Update update{0, scene_.time_step, company_.model.parameters.substeps, {}, false};
        for (int k = 0; k < runner_.states(); ++k) update.gaits.push_back(&members[std::min(k, count - 1)].gait);
        runner_.prepare(update);
        records_.clear();
        for (int k = 0; k < runner_.states(); ++k) records_.emplace_back(scene_, company_.model);
        const std::vector<typename Runner::Place> begin = runner_.places();
        const std::vector<Quad<Real>> bodies = places_of_bodies();
        for (int k = 0; k < runner_.states(); ++k)
            records_[k].start(frame_of(begin[k], false, bodies, k));
        const HostClock watch;
        const auto frames = static_cast<int>(std::lround(scene_.duration / scene_.time_step));
        for (int frame = 0; frame < frames && let_rest(count); ++frame) {
            update.start_time = frame * scene_.time_step;
            note(runner_.run(update, times_ ? times_->profile : nullptr), update);
        }
        if (times_) {
            times_->kernel += watch.seconds();
            times_->at_a_time = std::max(times_->at_a_time, count);
        }
        const std::vector<Real> densities = runner_.densities();
        const std::size_t fluid = runner_.model().view().fluid;
        for (int k = 0; k < count; ++k) {
            const auto own = densities.begin() + static_cast<std::ptrdiff_t>(densities.empty() ? 0 : k * fluid);
            const SwimRecord& record = records_[k];
            State<Real> end = runner_.download(k, initial_state<Real>(company_.model));
            end.origin = record.origin();
            evaluations.push_back(evaluation_of(
                scene_, company_.model, runner_.model().particle_of(), progress_[k],
                settled[k].stopped >= 0 ? nullptr : &members[k].gait, record.path().data(), record.tail(), end,
                std::vector<Real>(own, own + static_cast<std::ptrdiff_t>(densities.empty() ? 0 : fluid))));
            if (evaluations.back().instability) continue;
            evaluations.back().companions =
                companion_results(scene_, company_.model, settled_.at(start_of(members[k], scene_)).first, end);
            record.tell(evaluations.back());
        }
        forget_starts(first + count);
    }

private:
    using Runner = LargeRunner<Real>;

    /// Takes the members to their settled starts; those that begin alike share one.
    void start(const BatchMember* members, int count) {
        std::vector<Start> unsettled;
        for (int k = 0; k < count; ++k) {
            const Start start = start_of(members[k], scene_);
            if (!settled_.contains(start) && std::find(unsettled.begin(), unsettled.end(), start) == unsettled.end())
                unsettled.push_back(start);
        }
        progress_.assign(runner_.states(), Progress{});
        if (!unsettled.empty()) {
            const int different = static_cast<int>(unsettled.size());
            for (int k = 0; k < runner_.states(); ++k) runner_.upload(k, begin_of(unsettled[std::min(k, different - 1)]));
            settle(different);
            for (int k = 0; k < different; ++k)
                settled_[unsettled[k]] = {runner_.download(k, initial_state<Real>(company_.model)), progress_[k]};
        }
        for (int k = 0; k < runner_.states(); ++k) {
            const auto& [state, progress] = settled_.at(start_of(members[std::min(k, count - 1)], scene_));
            runner_.upload(k, state);
            progress_[k] = progress;
        }
    }

    State<Real> begin_of(const Start& start) const {
        const auto& [arrangement, amplitude, seed] = start;
        Model own = company_.model;
        own.position = company_.begin.at(arrangement);
        perturb({amplitude, seed}, own);
        return initial_state<Real>(own);
    }

    /// Keeps the settled starts that members from `next` on begin from.
    void forget_starts(int next) {
        std::map<Start, std::pair<State<Real>, Progress>> kept;
        for (std::size_t k = next; k < company_.members.size(); ++k)
            if (auto found = settled_.extract(start_of(company_.members[k], scene_))) kept.insert(std::move(found));
        settled_ = std::move(kept);
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
        const std::vector<Quad<Real>> bodies = places_of_bodies();
        for (int k = 0; k < runner_.states(); ++k) {
            Progress& progress = progress_[k];
            if (idle_[k] || note_instability(ends[k], update, progress)) continue;
            progress.muscle_work += ends[k].muscle_work;
            ++progress.frames;
            SwimRecord& record = records_[k];
            const auto over = record.add(frame_of(ends[k], ends[k].touches_plane, bodies, k));
            if (over) progress.stopped = static_cast<int>(*over);
            if (record.tank_is_due()) move_tank(k);
        }
    }

    /// Once for every step that a swimmer gets on; its State goes to the host and back.
    void move_tank(int k) {
        State<Real> state = runner_.download(k, runner_.muscles(k));
        records_[k].move_tank(state);
        runner_.upload(k, state);
    }

    std::vector<Quad<Real>> places_of_bodies() const {
        return records_.front().needs_body() ? runner_.body_places() : std::vector<Quad<Real>>{};
    }

    /// `place`: where State k's body is; `bodies`: of all States, or empty.
    template <class Place>
    SwimRecord::Frame frame_of(const Place& place, bool touches_plane, const std::vector<Quad<Real>>& bodies, int k) const {
        SwimRecord::Frame frame;
        frame.mean_x = place.mean_x;
        frame.tail_z = place.tail_z;
        frame.touches_plane = touches_plane;
        const std::size_t count = bodies.empty() ? 0 : company_.model.body.particles.size();
        for (std::size_t b = k * count; b < (k + 1) * count; ++b)
            frame.body.emplace_back(bodies[b].x, bodies[b].y, bodies[b].z);
        return frame;
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
    const Company& company_;
    BatchTimes* times_;
    Runner runner_;
    std::vector<Progress> progress_;
    std::vector<SwimRecord> records_;
    std::vector<bool> idle_;
    std::map<Start, std::pair<State<Real>, Progress>> settled_;
};

/// Side by side. While one waits for what takes long but is little, such as the solids of its States, the water of the others
/// fills the GPU. Three are hardly faster.
constexpr int most_streams = 2;
/// Of all streams together: so many fill a GPU; more at a time only take more memory.
constexpr int particles_at_a_time = 1'000'000;

/// The parts of a company that are computed one after another, side by side with those of other streams.
template <class Real>
class Stream {
public:
    Stream(const Scene& scene, const Company& company, const Parts& parts, int number, StageProfile* profile)
        : parts_(parts), number_(number), times_{.profile = profile}, large_(scene, company, parts.size, &times_) {}

    void evaluate() {
        for (int part = number_; part < parts_.count(); part += parts_.streams)
            large_.evaluate(parts_.first(part), parts_.size_of(part), evaluations_.emplace_back());
    }
    std::vector<Evaluation>& evaluations_of(int part) { return evaluations_[part / parts_.streams]; }
    const BatchTimes& times() const { return times_; }

private:
    const Parts& parts_;
    int number_;
    BatchTimes times_;
    LargeScene<Real> large_;
    std::vector<std::vector<Evaluation>> evaluations_;  ///< by part, of its own
};

/// The streams run side by side, so the longest counts.
template <class Real>
void add_times(const std::vector<std::unique_ptr<Stream<Real>>>& streams, BatchTimes& times) {
    BatchTimes all;
    for (const auto& stream : streams) {
        all.settling = std::max(all.settling, stream->times().settling);
        all.kernel = std::max(all.kernel, stream->times().kernel);
        all.at_a_time += stream->times().at_a_time;
    }
    times.settling += all.settling;
    times.kernel += all.kernel;
    times.at_a_time = std::max(times.at_a_time, all.at_a_time);
}

template <class Real>
std::vector<Evaluation> evaluate_in_parts(const Scene& scene, const Company& company, const Parts& parts,
                                          BatchTimes* times) {
    int device = 0;
    check(cudaGetDevice(&device), "device");
    std::vector<std::unique_ptr<Stream<Real>>> streams;
    for (int k = 0; k < parts.streams; ++k)
        streams.push_back(
            std::make_unique<Stream<Real>>(scene, company, parts, k, times ? times->profile : nullptr));
    std::vector<std::future<void>> others;
    for (int k = 1; k < parts.streams; ++k)
        others.push_back(std::async(std::launch::async, [&stream = *streams[k], device] {
            check(cudaSetDevice(device), "choose device");
            stream.evaluate();
        }));
    streams.front()->evaluate();
    for (std::future<void>& other : others) other.get();
    if (times) add_times(streams, *times);
    std::vector<Evaluation> evaluations;
    for (int part = 0; part < parts.count(); ++part)
        std::ranges::move(streams[part % parts.streams]->evaluations_of(part), std::back_inserter(evaluations));
    return evaluations;
}

/// Where there is not the memory for it, fewer at a time. Stages are timed in one stream, as those of two overlap.
template <class Real>
std::vector<Evaluation> evaluate_company(const Scene& scene, const Company& company, BatchTimes* times) {
    const int members = static_cast<int>(company.members.size());
    int streams = times && times->profile ? 1 : most_streams;
    int most = Parts::most_of(members, streams, particles_at_a_time / streams / company.model.particles() + 1);
    for (;;) {
        try {
            return evaluate_in_parts<Real>(scene, company, Parts(members, most, streams), times);
        } catch (const std::bad_alloc&) {
            if (most == 1 && streams == 1) throw;
            if (most == 1) streams = 1;
            most = (most + 1) / 2;
        }
    }
}

/// `model`: the scene's own.
Model arranged(Scene scene, const Model& model, int arrangement) {
    if (arrangement == scene.fluid->disorder) return model;
    scene.fluid->disorder = arrangement;
    return build_model(scene);
}

/// Where nothing but the water's places depends on its arrangement, the device gets the Model of the usual one whatever the
/// members', so that a member's bits do not depend on its company. An arrangement that asks for more substeps, say, stays
/// alone.
std::vector<Company> companies(const Scene& scene, const Model& model, const std::vector<BatchMember>& members) {
    std::vector<Company> all;
    std::map<int, std::size_t> company_of;
    const bool arranges = model.scheme == Scheme::conserving && scene.fluid;
    const int usual = arranges ? FluidBlock{}.disorder : 0;
    all.push_back({arranges ? arranged(scene, model, usual) : model, {}});
    for (std::size_t k = 0; k < members.size(); ++k) {
        const int arrangement = arrangement_of(members[k], scene);
        if (!company_of.contains(arrangement)) {
            const Model own = arranges && arrangement != usual ? arranged(scene, model, arrangement) : all.front().model;
            const Model& first = all.front().model;
            const bool alike =
                own.inverse_mass == first.inverse_mass && own.parameters.substeps == first.parameters.substeps;
            if (!alike) all.push_back({own, {}});
            company_of[arrangement] = alike ? 0 : all.size() - 1;
            all[company_of[arrangement]].begin[arrangement] = own.position;
        }
        Company& company = all[company_of[arrangement]];
        company.members.push_back(members[k]);
        company.numbers.push_back(k);
    }
    return all;
}

}  // namespace

template <class Real>
std::vector<Evaluation> evaluate_large(const Scene& scene, const Model& model, const std::vector<BatchMember>& members,
                                       BatchTimes* times) {
    std::vector<Evaluation> evaluations(members.size());
    for (const Company& company : companies(scene, model, members)) {
        if (company.members.empty()) continue;
        const std::vector<Evaluation> own = evaluate_company<Real>(scene, company, times);
        for (std::size_t k = 0; k < own.size(); ++k) evaluations[company.numbers[k]] = own[k];
    }
    return evaluations;
}

template std::vector<Evaluation> evaluate_large<float>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                       BatchTimes*);
template std::vector<Evaluation> evaluate_large<double>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                        BatchTimes*);

}  // namespace natator::cuda
