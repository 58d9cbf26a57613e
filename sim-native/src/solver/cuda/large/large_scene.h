#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "busy_time.h"
#include "company.h"
#include "evaluate/companions.h"
#include "evaluate/perturb.h"
#include "evaluate/side_by_side.h"
#include "evaluate/swim_record.h"
#include "large_runner.h"
#include "solver/cuda/evaluation.h"
#include "solver/cuda/kept_starts.h"

namespace natator::cuda {

class HostClock {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Where a member begins, if places are the same.
using Start = std::tuple<int, double, std::uint64_t>;

inline Start start_of(const BatchMember& member, const Scene& scene) {
    const Perturbation& shift = member.perturbation;
    return {arrangement_of(member, scene), shift.amplitude, shift.amplitude == 0 ? 0 : shift.seed};
}

/// Evaluates as many members at a time as there are States side by side.
template <class Real>
class LargeScene {
public:
    LargeScene(const Scene& scene, const Company& company, int states, WaterLists lists, bool keeps_starts, BatchTimes* times)
        : scene_(scene),
          company_(company),
          keeps_starts_(keeps_starts),
          times_(times),
          runner_(company.model, states, {.lists = lists}) {}

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
        const HostTime begin_of_frames = std::chrono::steady_clock::now();
        const auto frames = static_cast<int>(std::lround(scene_.duration / scene_.time_step));
        for (int frame = 0; frame < frames && let_rest(count); ++frame) {
            update.start_time = frame * scene_.time_step;
            note(runner_.run(update, times_ ? times_->profile : nullptr), update);
        }
        busy_.push_back({begin_of_frames, std::chrono::steady_clock::now()});
        if (times_) {
            times_->at_a_time = std::max(times_->at_a_time, count);
        }
        const std::vector<Real> densities = runner_.densities();
        std::vector<State<Real>> ends;
        for (int k = 0; k < count; ++k) ends.push_back(runner_.download(k, initial_state<Real>(company_.model)));
        const std::size_t before = evaluations.size();
        evaluations.resize(before + count);
        side_by_side(count, [&](std::size_t number) {
            const int k = static_cast<int>(number);
            const Gait* const gait = settled[k].stopped >= 0 ? nullptr : &members[k].gait;
            evaluations[before + k] = evaluation_of_member(k, members[k], gait, ends[k], densities);
        });
        forget_starts(first + count);
    }

    /// When frames were computed.
    const std::vector<Span>& busy() const { return busy_; }

private:
    using Runner = LargeRunner<Real>;

    /// `gait` as for evaluation_of; `densities` of all States.
    Evaluation evaluation_of_member(int k, const BatchMember& member, const Gait* gait, State<Real>& end,
                                    const std::vector<Real>& densities) const {
        const SwimRecord& record = records_[k];
        end.origin = record.origin();
        const std::size_t fluid = densities.size() / runner_.states();
        const Real* const own = densities.data() + k * fluid;
        Evaluation evaluation =
            evaluation_of(scene_, company_.model, runner_.model().particle_of(), progress_[k], gait, record.path().data(),
                          record.tail(), end, std::vector<Real>(own, own + fluid));
        if (evaluation.instability) return evaluation;
        evaluation.companions =
            companion_results(scene_, company_.model, settled_.at(start_of(member, scene_)).first, end);
        record.tell(evaluation);
        return evaluation;
    }

    /// Takes the members to their settled starts; those that begin alike share one.
    void start(const BatchMember* members, int count) {
        std::vector<Start> unsettled;
        std::vector<std::optional<std::string>> keys;  // of those
        for (int k = 0; k < count; ++k) {
            const Start start = start_of(members[k], scene_);
            if (settled_.contains(start) || std::find(unsettled.begin(), unsettled.end(), start) != unsettled.end()) continue;
            std::optional<std::string> key = key_of(start);
            if (auto known = kept_starts().find(key)) {
                settled_[start] = {std::move(known->state), Progress{}};
                runner_.make_room(known->room);
            } else {
                unsettled.push_back(start);
                keys.push_back(std::move(key));
            }
        }
        progress_.assign(runner_.states(), Progress{});
        if (!unsettled.empty()) {
            const int different = static_cast<int>(unsettled.size());
            for (int k = 0; k < runner_.states(); ++k) runner_.upload(k, begin_of(unsettled[std::min(k, different - 1)]));
            settle(different);
            for (int k = 0; k < different; ++k) {
                const State<Real> state = runner_.download(k, initial_state<Real>(company_.model));
                settled_[unsettled[k]] = {state, progress_[k]};
                if (progress_[k].stopped < 0) kept_starts().keep(keys[k], {state, runner_.room()});
            }
        }
        for (int k = 0; k < runner_.states(); ++k) {
            const auto& [state, progress] = settled_.at(start_of(members[std::min(k, count - 1)], scene_));
            runner_.upload(k, state);
            progress_[k] = progress;
        }
    }

    /// What begins so.
    Model model_of(const Start& start) const {
        const auto& [arrangement, amplitude, seed] = start;
        Model own = company_.model;
        own.position = company_.begin.at(arrangement);
        perturb({amplitude, seed}, own);
        return own;
    }
    State<Real> begin_of(const Start& start) const { return initial_state<Real>(model_of(start)); }

    /// Of all scenes that the whole GPU computes.
    static KeptStarts<Real>& kept_starts() {
        static KeptStarts<Real> kept;
        return kept;
    }
    /// None if it is not to be kept.
    std::optional<std::string> key_of(const Start& start) const {
        return keeps_starts_ ? KeptStarts<Real>::key_of(model_of(start), scene_.settling) : std::nullopt;
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
    bool keeps_starts_;
    BatchTimes* times_;
    std::vector<Span> busy_;
    Runner runner_;
    std::vector<Progress> progress_;
    std::vector<SwimRecord> records_;
    std::vector<bool> idle_;
    std::map<Start, std::pair<State<Real>, Progress>> settled_;
};

}  // namespace natator::cuda
