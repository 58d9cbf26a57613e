#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "busy_time.h"
#include "device_state_cache.h"
#include "evaluation.h"
#include "model_group.h"
#include "run/companions.h"
#include "run/laws.h"
#include "run/perturb.h"
#include "run/side_by_side.h"
#include "run/swim_record.h"
#include "shared_once.h"
#include "solver/cuda/grid/grid_runner.h"

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

inline std::vector<Start> starts_of(const Scene& scene, std::span<const BatchMember> members) {
    std::vector<Start> starts;
    for (const BatchMember& member : members) {
        const Perturbation& shift = member.perturbation;
        starts.emplace_back(arrangement_of(member, scene), shift.amplitude, shift.amplitude == 0 ? 0 : shift.seed);
    }
    return starts;
}

/// What settling makes of a start.
template <class Real>
struct Settled {
    KeptStart<Real> start;
    Progress progress;
};
template <class Real>
using SettledStarts = SharedOnce<Start, Settled<Real>>;

/// Evaluates as many members at a time as there are States side by side.
template <class Real>
class GridScene {
public:
    /// `starts` of all members of the company.
    GridScene(const Scene& scene, const ModelGroup& company, SettledStarts<Real>& starts, int states, WaterLists lists,
               bool keeps_starts, BatchTimes* times)
        : scene_(scene),
          company_(company),
          starts_(starts),
          keeps_starts_(keeps_starts),
          times_(times),
          runner_(company.model, states, {.lists = lists}) {}

    /// Members from `first` on, at most as many as there are States.
    void evaluate(int first, int count, std::vector<Evaluation>& evaluations) {
        const std::span<const BatchMember> members(company_.members.data() + first, count);
        const std::vector<Start> starts = starts_of(scene_, members);
        begin_at(starts);
        typename Runner::Update update{0, scene_.time_step, company_.model.parameters.substeps, {}, false};
        for (int k = 0; k < runner_.states(); ++k) update.gaits.push_back(&members[std::min(k, count - 1)].gait);
        runner_.prepare(update);
        records_.clear();
        for (int k = 0; k < runner_.states(); ++k) records_.emplace_back(scene_, company_.model);
        const std::vector<typename Runner::Place> begin = runner_.places();
        const std::vector<Vec4<Real>> bodies = places_of_bodies();
        for (int k = 0; k < runner_.states(); ++k)
            records_[k].start(frame_of(begin[k], false, bodies, k));
        watches_.clear();
        for (int k = 0; k < runner_.states(); ++k) {
            const int member = std::min(k, count - 1);
            watches_.push_back(laws_of(std::get<0>(starts[member])));
            watches_[k].drive_by(members[member].gait);
            note_breach(watches_[k].start(begin[k].laws), progress_[k]);
        }
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
            const Gait* const gait = begins_[k]->progress.stopped >= 0 ? nullptr : &members[k].gait;
            evaluations[before + k] = evaluation_of_member(k, gait, ends[k], densities);
        });
        begins_.clear();
        starts_.leave(starts);
    }

    /// When frames were computed.
    const std::vector<Span>& busy() const { return busy_; }

private:
    using Runner = GridRunner<Real>;

    /// `gait` as for evaluation_of; `densities` of all States.
    Evaluation evaluation_of_member(int k, const Gait* gait, State<Real>& end, const std::vector<Real>& densities) const {
        const SwimRecord& record = records_[k];
        end.origin = record.origin();
        const std::size_t fluid = densities.size() / runner_.states();
        const Real* const own = densities.data() + k * fluid;
        Evaluation evaluation =
            evaluation_of(scene_, company_.model, runner_.model().particle_of(), progress_[k], gait, record.path().data(),
                          record.tail(), end, std::vector<Real>(own, own + fluid));
        if (evaluation.instability) return evaluation;
        evaluation.companions = companion_results(scene_, company_.model, begins_[k]->start.state, end);
        record.tell(evaluation);
        return evaluation;
    }

    /// Takes the States to the members' settled starts, and those without a member to the last.
    void begin_at(const std::vector<Start>& starts) {
        const std::vector<Start> claimed = starts_.claim(starts);
        try {
            give(claimed);
        } catch (...) {  // others may wait for them
            starts_.fail(claimed, std::current_exception());
            throw;
        }
        progress_.clear();
        for (int k = 0; k < runner_.states(); ++k) {
            const auto& begin = begins_.emplace_back(starts_.of(starts[std::min<std::size_t>(k, starts.size() - 1)]));
            runner_.make_room(begin->start.room);
            runner_.upload(k, begin->start.state);
            progress_.push_back(begin->progress);
        }
    }

    /// Settles starts side by side, but for those that are kept from an earlier batch.
    void give(const std::vector<Start>& claimed) {
        std::vector<Start> unsettled;
        std::vector<std::optional<std::string>> keys;  // of those
        for (const Start& start : claimed) {
            std::optional<std::string> key = key_of(start);
            if (auto known = device_state_cache().find(key)) {
                starts_.give(start, {std::move(*known), Progress{}});
            } else {
                unsettled.push_back(start);
                keys.push_back(std::move(key));
            }
        }
        if (unsettled.empty()) return;
        const int different = static_cast<int>(unsettled.size());
        State<Real> begin;
        for (int k = 0; k < runner_.states(); ++k) {
            if (k < different) begin = begin_of(unsettled[k]);
            runner_.upload(k, begin);  // idle ones are like the last
        }
        progress_.assign(runner_.states(), Progress{});
        settle(different);
        for (int k = 0; k < different; ++k) {
            const KeptStart<Real> settled{runner_.download(k, initial_state<Real>(company_.model)), runner_.room()};
            if (progress_[k].stopped < 0) device_state_cache().keep(keys[k], settled);
            starts_.give(unsettled[k], {settled, progress_[k]});
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
    static DeviceStateCache<Real>& device_state_cache() {
        static DeviceStateCache<Real> kept;
        return kept;
    }
    /// None if it is not to be kept.
    std::optional<std::string> key_of(const Start& start) const {
        return keeps_starts_ ? DeviceStateCache<Real>::key_of(model_of(start), scene_.settling) : std::nullopt;
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
        const std::vector<Vec4<Real>> bodies = places_of_bodies();
        for (int k = 0; k < runner_.states(); ++k) {
            Progress& progress = progress_[k];
            if (idle_[k] || note_instability(ends[k], update, progress)) continue;
            progress.muscle_work += ends[k].muscle_work;
            ++progress.frames;
            if (note_breach(watches_[k].look(ends[k].laws, progress.muscle_work, progress.frames * scene_.time_step), progress)) continue;
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
        watches_[k].begin_anew();
    }

    std::vector<Vec4<Real>> places_of_bodies() const {
        return records_.front().needs_body() ? runner_.body_places() : std::vector<Vec4<Real>>{};
    }

    /// `place`: where State k's body is; `bodies`: of all States, or empty.
    template <class Place>
    SwimRecord::Frame frame_of(const Place& place, bool touches_plane, const std::vector<Vec4<Real>>& bodies, int k) const {
        SwimRecord::Frame frame;
        frame.mean_x = place.mean_x;
        frame.tail_z = place.tail_z;
        frame.touches_plane = touches_plane;
        const std::size_t count = bodies.empty() ? 0 : company_.model.body.particles.size();
        for (std::size_t b = k * count; b < (k + 1) * count; ++b)
            frame.body.emplace_back(bodies[b].x, bodies[b].y, bodies[b].z);
        return frame;
    }

    /// Of scenes that begin in an arrangement.
    const LawWatch& laws_of(int arrangement) {
        auto known = laws_.find(arrangement);
        if (known == laws_.end()) known = laws_.emplace(arrangement, LawWatch(model_of({arrangement, 0, 0}))).first;
        return known->second;
    }

    /// Is there one? A particle has its device number in measures.
    static bool note_breach(const std::optional<Instability>& found, Progress& progress) {
        if (!found || progress.stopped >= 0) return false;
        progress.stopped = static_cast<int>(StopReason::unstable);
        progress.broken = law_named(found->law);
        progress.bad_particle = found->particle;
        progress.bad_time = found->time;
        return true;
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
    const ModelGroup& company_;
    SettledStarts<Real>& starts_;
    bool keeps_starts_;
    BatchTimes* times_;
    std::vector<Span> busy_;
    Runner runner_;
    std::vector<Progress> progress_;
    std::vector<SwimRecord> records_;
    std::map<int, LawWatch> laws_;  ///< by arrangement, see laws_of
    std::vector<LawWatch> watches_;  ///< by State
    std::vector<bool> idle_;
    std::vector<std::shared_ptr<const Settled<Real>>> begins_;  ///< by State, where they began
};

}  // namespace natator::cuda
