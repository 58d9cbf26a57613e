#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "base/side_by_side.h"
#include "busy_time.h"
#include "evaluation.h"
#include "model_group.h"
#include "natator/settled_state_cache.h"
#include "run/perturb.h"
#include "shared_once.h"
#include "solver/cuda/device.h"
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
struct SettledMember {
    State<Real> state;
    ListRoom room{};  ///< of lists since it settled; none of one that was kept
    std::optional<Instability> instability{};
};
template <class Real>
using SettledStarts = SharedOnce<Start, SettledMember<Real>>;

/// Evaluates as many members at a time as there are States side by side.
template <class Real>
class GridScene {
public:
    /// `starts` of all members of the group, kept in `cache` if it is not null.
    GridScene(const Scene& scene, const ModelGroup& group, SettledStarts<Real>& starts, int states, WaterLists lists,
              const SettledStateCache* cache, BatchTimes* times)
        : scene_(scene),
          group_(group),
          starts_(starts),
          cache_(cache),
          times_(times),
          runner_(group.model, states, {.lists = lists}) {}

    /// Members from `first` on, at most as many as there are States.
    void evaluate(int first, int count, std::vector<Evaluation>& evaluations) {
        const std::span<const BatchMember> members(group_.members.data() + first, count);
        const std::vector<Start> starts = starts_of(scene_, members);
        begin_at(starts);
        update_ = {scene_.time_step, group_.model.parameters.substeps, {}, false};
        for (int k = 0; k < runner_.states(); ++k)
            update_.muscles.push_back({[this, &gait = members[std::min(k, count - 1)].gait](double time) {
                                           return drive(group_.model, gait, time);
                                       },
                                       0});
        runner_.prepare(update_);
        std::vector<EvaluationRun> runs;
        runs.reserve(count);
        for (int k = 0; k < count; ++k)
            runs.emplace_back(scene_, group_.model, members[k].gait, laws_of(std::get<0>(starts[k])));
        needs_body_ = runs.front().needs_body();
        work_.assign(count, std::vector<double>(group_.model.swimmers()));
        const HostTime begin_of_frames = std::chrono::steady_clock::now();
        run_frames(scene_, *this, runs);
        busy_.push_back({begin_of_frames, std::chrono::steady_clock::now()});
        if (times_) times_->at_a_time = std::max(times_->at_a_time, count);
        const std::vector<Real> densities = runner_.densities();
        const std::size_t before = evaluations.size(), fluid = densities.size() / runner_.states();
        std::vector<State<Real>> ends;
        for (int k = 0; k < count; ++k) {
            ends.push_back(runner_.download(k, initial_state<Real>(group_.model)));
            ends.back().origin = runs[k].origin();
        }
        evaluations.resize(before + count);
        side_by_side(count, [&](std::size_t k) {
            evaluations[before + k] =
                finish(runs[k], scene_, group_.model, runner_.model().particle_of(), members[k].gait,
                       !begins_[k]->instability, begins_[k]->state, ends[k], densities.data() + k * fluid, fluid);
        });
        begins_.clear();
        starts_.release(starts);
    }

    // As run_frames asks for it.
    std::vector<FrameEnd> start() {
        const std::vector<typename Runner::Place> places = runner_.places();
        std::vector<FrameEnd> ends = ends_of(places);
        for (std::size_t k = 0; k < ends.size(); ++k) ends[k].instability = begins_[k]->instability;
        return ends;
    }
    std::vector<FrameEnd> frame(int number, std::vector<bool> over) {
        let_rest(std::move(over));
        for (auto& muscles : update_.muscles) muscles.start_time = number * scene_.time_step;
        const std::vector<typename Runner::End> found = runner_.run(update_, times_ ? times_->profile : nullptr);
        std::vector<FrameEnd> ends = ends_of(found);
        for (std::size_t k = 0; k < ends.size(); ++k) {
            ends[k].instability = instability_of(found[k], number * scene_.time_step, update_);
            for (std::size_t s = 0; s < found[k].muscle_work.size(); ++s) work_[k][s] += found[k].muscle_work[s];
            ends[k].work = work_[k];
            ends[k].frame.touches_plane = found[k].touches_plane;
        }
        return ends;
    }
    /// The tank moves once for every step that a swimmer gets on; its State goes to the host and back.
    void record_frame(std::size_t k, EvaluationRun& run) {
        if (run.frames() == 0 || !run.tank_is_due()) return;
        State<Real> state = runner_.download(static_cast<int>(k), runner_.muscles(static_cast<int>(k)));
        run.move_tank(state);
        runner_.upload(static_cast<int>(k), state);
    }

    /// When frames were computed.
    const std::vector<Span>& busy() const { return busy_; }

private:
    using Runner = GridRunner<Real>;

    /// Takes the States to the members' settled starts, and those without a member to the last.
    void begin_at(const std::vector<Start>& starts) {
        const std::vector<Start> acquired = starts_.acquire(starts);
        try {
            publish(acquired);
        } catch (...) {  // others may wait for them
            starts_.fail(acquired, std::current_exception());
            throw;
        }
        for (int k = 0; k < runner_.states(); ++k) {
            const auto& begin = begins_.emplace_back(starts_.get(starts[std::min<std::size_t>(k, starts.size() - 1)]));
            runner_.make_room(begin->room);
            runner_.upload(k, begin->state);
        }
    }

    /// Settles starts side by side, but for those that are kept from an earlier batch.
    void publish(const std::vector<Start>& acquired) {
        std::vector<Start> unsettled;
        for (const Start& start : acquired) {
            std::optional<State<Real>> known;
            if (is_kept(start)) known = cache_->find<Real>(model_of(start), scene_.settling, device_);
            if (known)
                starts_.publish(start, {std::move(*known)});
            else
                unsettled.push_back(start);
        }
        if (unsettled.empty()) return;
        const std::size_t different = unsettled.size();
        State<Real> begin;
        for (int k = 0; k < runner_.states(); ++k) {
            if (k < static_cast<int>(different)) begin = initial_state<Real>(model_of(unsettled[k]));
            runner_.upload(k, begin);  // idle ones are like the last
        }
        const std::vector<std::optional<Instability>> found = settle(different);
        for (std::size_t k = 0; k < different; ++k) {
            const State<Real> settled = runner_.download(static_cast<int>(k), initial_state<Real>(group_.model));
            if (!found[k] && is_kept(unsettled[k]))
                cache_->keep(model_of(unsettled[k]), scene_.settling, settled, device_);
            starts_.publish(unsettled[k], {settled, runner_.room(), found[k]});
        }
    }

    /// As on the CPU: of perturbations there are as many as seeds.
    bool is_kept(const Start& start) const { return cache_ && std::get<1>(start) == 0; }

    /// What begins so.
    Model model_of(const Start& start) const {
        const auto& [arrangement, amplitude, seed] = start;
        Model own = group_.model;
        own.position = group_.begin.at(arrangement);
        perturb({amplitude, seed}, own);
        return own;
    }

    std::vector<std::optional<Instability>> settle(std::size_t count) {
        const HostClock watch;
        const Settling& settling = scene_.settling;
        const typename Runner::Update update{settling.time_step, settling.substeps, {}, true};
        std::vector<std::optional<Instability>> found(count);
        for (int k = 0; k < settling.updates; ++k) {
            std::vector<bool> over(count);
            for (std::size_t state = 0; state < count; ++state) over[state] = found[state].has_value();
            if (!let_rest(std::move(over))) break;
            const std::vector<typename Runner::End> ends = runner_.run(update);
            for (std::size_t state = 0; state < count; ++state)
                if (!found[state]) found[state] = instability_of(ends[state], 0, update);
        }
        if (times_) times_->settling += watch.seconds();
        return found;
    }

    /// What is over, and States without a member, stay as they are. False if all do.
    bool let_rest(std::vector<bool> over) {
        over.resize(runner_.states(), true);
        if (over != idle_) runner_.set_idle(over);
        idle_ = std::move(over);
        return std::ranges::find(idle_, false) != idle_.end();
    }

    /// Of all members, from where the device says that they are.
    template <class Place>
    std::vector<FrameEnd> ends_of(const std::vector<Place>& places) const {
        const std::vector<Vec4<Real>> bodies = needs_body_ ? runner_.body_places() : std::vector<Vec4<Real>>{};
        const std::size_t count = bodies.size() / runner_.states();
        std::vector<FrameEnd> ends(work_.size());
        for (std::size_t k = 0; k < ends.size(); ++k) {
            ends[k].laws = places[k].laws;
            ends[k].frame.mean_x = places[k].mean_x;
            ends[k].frame.tail_z = places[k].tail_z;
            for (std::size_t b = k * count; b < (k + 1) * count; ++b)
                ends[k].frame.body.emplace_back(bodies[b].x, bodies[b].y, bodies[b].z);
        }
        return ends;
    }

    /// Of scenes that begin in an arrangement.
    const LawWatch& laws_of(int arrangement) {
        auto known = laws_.find(arrangement);
        if (known == laws_.end()) known = laws_.emplace(arrangement, LawWatch(model_of({arrangement, 0, 0}))).first;
        return known->second;
    }

    /// Of an update from `start` (s) that is not finite; the particle by device number.
    static std::optional<Instability> instability_of(const typename Runner::End& end, double start,
                                                     const typename Runner::Update& update) {
        if (end.finite) return std::nullopt;
        return Instability{end.bad_particle, "velocities",
                           start + end.bad_substep * update.time_step / update.substeps};
    }

    const Scene& scene_;
    const ModelGroup& group_;
    SettledStarts<Real>& starts_;
    const SettledStateCache* cache_;
    std::string device_ = current_device_name() + " grid ";
    BatchTimes* times_;
    std::vector<Span> busy_;
    Runner runner_;
    typename Runner::Update update_;         ///< of a frame
    bool needs_body_ = false;                ///< see EvaluationRun
    std::vector<std::vector<double>> work_;  ///< of the muscles, by member and swimmer
    std::map<int, LawWatch> laws_;           ///< by arrangement, see laws_of
    std::vector<bool> idle_;
    std::vector<std::shared_ptr<const SettledMember<Real>>> begins_;  ///< by State, where they began
};

}  // namespace natator::cuda
