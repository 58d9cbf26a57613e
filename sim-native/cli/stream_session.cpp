#include "stream_session.h"

#include <algorithm>
#include <cmath>

#include "base/check_values.h"
#include "base/strict_json.h"
#include "base/text.h"
#include "commands.h"
#include "natator/error.h"
#include "protocol/protocol.h"

namespace natator::cli {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// What is wrong with a swimmer that a command names is told with its number.
template <class Work>
auto for_swimmer(int swimmer, bool named, const Work& work) {
    try {
        return work();
    } catch (const InputError& error) {
        if (!named) throw;
        throw InputError("swimmer " + std::to_string(swimmer) + ": " + error.what());
    }
}

/// Refuses a model with other bodies.
auto body_check(const stream::Bodies& asked) {
    return [&asked](const Model& model) {
        if (!asked) return;
        const auto refuse = [](const std::string& who, int has, const char* of, const std::string& must) {
            throw InputError(who + " would have " + std::to_string(has) + of + ": must have " + must);
        };
        if (model.swimmers() != static_cast<int>(asked->size()))
            refuse("the scene", model.swimmers(), " swimmers", std::to_string(asked->size()));
        for (int k = 0; k < model.swimmers(); ++k) {
            const auto& [actuators, slices] = (*asked)[static_cast<std::size_t>(k)];
            const int own = static_cast<int>(model.body_of(k).slices.size());
            const std::string who = "swimmer " + std::to_string(k);
            if (model.actuators_of(k) != actuators)
                refuse(who, model.actuators_of(k), " actuators", std::to_string(actuators));
            if (own < slices) refuse(who, own, " slices", "at least " + std::to_string(slices));
        }
    };
}

/// Part of values of all swimmers, one after the other, that is one's.
std::vector<double> part_of(const std::vector<double>& values, const Model& model, int swimmer) {
    return {values.begin() + model.first_actuator_of(swimmer), values.begin() + model.first_actuator_of(swimmer + 1)};
}

}  // namespace

template <class Real>
StreamSession<Real>::StreamSession(const SimulationSetup& setup, const Execution& execution,
                                   const StreamSettings& settings)
    : settings_(settings),
      simulation_(setup, execution),
      pace_(settings.rate),
      running_(!settings.paused),
      policy_(settings.policy) {
    forget_senses();
    if (policy_) begin_policy();
}

template <class Real>
void StreamSession<Real>::go_on() {
    pace_.begin_frame(simulation_.scene().time_step);
    drive_by_policy();
    if (simulate()) due_ = simulation_.frames() % settings_.every == 0;
}

/// What a command causes comes before its answer.
template <class Real>
void StreamSession<Real>::carry_out(const json& command) {
    answer_ = {{"id", request_id(command)}};
    try {
        refuse_if(ended_);
        answer_["ok"] = true;
        std::visit([this](const auto& one) { this->apply(one); }, parse_stream_command(command));
    } catch (const InputError& error) {
        answer_ = {{"id", answer_["id"]}, {"error", error.what()}};
    } catch (const std::bad_alloc& error) {
        answer_ = {{"id", answer_["id"]}, {"error", message_of(error)}};
    }
    say(stream_message("ANSW", answer_));
}

template <class Real>
template <class Work>
void StreamSession<Real>::or_refuse(const Work& work) {
    if (outcome_.status == stream::Outcome::refused) return;
    try {
        return work();
    } catch (const InputError& error) {
        outcome_.refusal = error.what();
    } catch (const std::bad_alloc& error) {
        outcome_.refusal = message_of(error);
    }
    outcome_.status = stream::Outcome::refused;
    under_way_ = {};
}

template <class Real>
stream::Outcome StreamSession<Real>::act(const stream::Action& action) {
    begin_act(action);
    while (next_of_act()) or_refuse([this] { simulate(); });
    return end_act();
}

template <class Real>
void StreamSession<Real>::begin_act(const stream::Action& action) {
    outcome_ = {};
    or_refuse([&] {
        if (!action.refusal.empty()) throw InputError(action.refusal);
        if (!action.step) return;
        refuse_if(ended_);
        begin_step(*action.step);
    });
}

template <class Real>
Simulation<Real>* StreamSession<Real>::next_of_act() {
    bool goes_on = false;
    or_refuse([&] { goes_on = steer_next_frame(); });
    return goes_on ? &simulation_ : nullptr;
}

template <class Real>
void StreamSession<Real>::end_frame_of_act(bool stable, double wall_seconds) {
    or_refuse([&] { end_frame(stable, wall_seconds); });
}

template <class Real>
stream::Outcome StreamSession<Real>::end_act() {
    or_refuse([&] {
        if (!under_way_.step) return;
        end_step();
        outcome_.status = simulation_.instability() ? stream::Outcome::unstable : stream::Outcome::stepped;
    });
    outcome_.senses = stream_sense_numbers(simulation_, sensing_);
    return std::move(outcome_);
}

template <class Real>
void StreamSession<Real>::apply(const stream::Credit& credit) {
    credit_ = std::min(credit_ + credit.frames, stream::max_credit);
}

template <class Real>
void StreamSession<Real>::apply(const stream::Run&) {
    refuse_if_unstable();
    running_ = true;
    pace_.restart();
}

template <class Real>
void StreamSession<Real>::apply(const stream::Pause&) {
    running_ = false;
}

template <class Real>
void StreamSession<Real>::apply(const stream::Step& step) {
    begin_step(step);
    try {
        while (steer_next_frame()) simulate();
    } catch (...) {
        under_way_ = {};
        throw;
    }
    end_step();
    if (step.sense) answer_["senses"] = senses();
}

template <class Real>
void StreamSession<Real>::begin_step(const stream::Step& step) {
    refuse_if_unstable();
    refuse_if(at_end());
    std::vector<std::vector<Steered>> rows = checked(step);
    offer_frame();
    if (due_ && settings_.lossless) throw InputError("command: do = \"step\": the last frame still waits for credit");
    if (due_) drop_frame();
    running_ = false;
    if (rows.size() == 1) apply(rows.front());
    under_way_ = {.step = &step, .rows = std::move(rows)};
}

/// False when there is no frame left.
template <class Real>
bool StreamSession<Real>::steer_next_frame() {
    const auto& [step, frames, stable, rows] = under_way_;
    if (!step || !stable || frames == static_cast<std::size_t>(step->frames) || at_end()) return false;
    if (rows.size() > 1) apply(rows[frames]);
    drive_by_policy();
    return true;
}

/// Throws InputError where it does not fit the body.
template <class Real>
void StreamSession<Real>::begin_policy() {
    policy_->check(simulation_.model());
    if (policy_->gait()) simulation_.set_gait(*policy_->gait());
    if (!sensing_.front().target) sensing_.front().target = policy_->target();
    policy_->restart();
}

/// After another body or moment; a policy that does not fit it goes.
template <class Real>
void StreamSession<Real>::restart_policy() {
    if (!policy_) return;
    try {
        begin_policy();
    } catch (const InputError&) {
        policy_.reset();
    }
}

template <class Real>
void StreamSession<Real>::drive_by_policy() {
    if (policy_) simulation_.steer(policy_->next(simulation_, sensing_.front().target));
}

template <class Real>
void StreamSession<Real>::end_step() {
    const bool stable = std::exchange(under_way_, {}).stable;
    due_ = stable;
    offer_frame();
    if (stable) end_if_reached();
}

/// What a step asks of swimmers, by row: nothing is simulated with commands of which one can't be used.
template <class Real>
auto StreamSession<Real>::checked(const stream::Step& step) const -> std::vector<std::vector<Steered>> {
    std::vector<std::vector<Steered>> rows;
    for (std::size_t i = 0; i < step.steer.size(); ++i)
        rows.push_back(steered_by(step.steer[i], step.steer.size() > 1 ? "[" + std::to_string(i) + "]" : ""));
    if (step.sense) check_sensing(sensing_.front(), simulation_.model());
    return rows;
}

/// A command as those for each swimmer that its values are for: one, or all, one after the other.
template <class Real>
std::vector<stream::Steer> StreamSession<Real>::by_swimmer(const stream::Steer& steer, const std::string& row) const {
    const Model& model = simulation_.model();
    if (steer.swimmer || model.swimmers() == 1) return {steer};
    using Values = std::optional<std::vector<double>>;
    constexpr std::pair<const char*, Values stream::Steer::*> lists[] = {
        {"drive", &stream::Steer::drive}, {"scale", &stream::Steer::scale}, {"offset", &stream::Steer::offset}};
    const int own = model.actuators, all = model.first_actuator_of(model.swimmers());
    const bool for_all = all != own && std::any_of(std::begin(lists), std::end(lists), [&](const auto& one) {
                             const Values& values = steer.*one.second;
                             return values && values->size() == static_cast<std::size_t>(all);
                         });
    for (const auto& [name, list] : lists) {
        const Values& values = steer.*list;
        if (!values) continue;
        if (for_all)
            check_length(name, values->size(), all);
        else if (values->size() != static_cast<std::size_t>(own))
            throw InputError(name + row + " has length " + std::to_string(values->size()) + ": must have length " +
                             std::to_string(own) + ", one value per actuator of the creature, or " +
                             std::to_string(all) + ", of all swimmers");
    }
    if (!for_all) return {steer};
    std::vector<stream::Steer> parts(static_cast<std::size_t>(model.swimmers()));
    for (int k = 0; k < model.swimmers(); ++k) {
        parts[k].swimmer = k;
        for (const auto& [name, list] : lists)
            if (const Values& values = steer.*list) parts[k].*list = part_of(*values, model, k);
    }
    return parts;
}

/// What a command asks of swimmers. Throws InputError where one can't do it.
template <class Real>
auto StreamSession<Real>::steered_by(const stream::Steer& steer, const std::string& row) const -> std::vector<Steered> {
    std::vector<Steered> steered;
    for (const stream::Steer& part : by_swimmer(steer, row)) {
        const int swimmer = part.swimmer.value_or(0);
        const Gait& gait = simulation_.gait(swimmer);
        const int actuators = simulation_.model().actuators_of(swimmer);
        for_swimmer(swimmer, part.swimmer.has_value(), [&] {
            Steering steering = no_steering(actuators);
            if (part.drive) {
                check_drive(*part.drive, actuators, ("drive" + row).c_str());
                steering = steering_of_drive(*part.drive);
            }
            if (part.scale) steering.scale = *part.scale;
            if (part.offset) steering.offset = *part.offset;
            check_steering(steering, gait, actuators);
            steered.push_back({swimmer, std::move(steering)});
        });
    }
    return steered;
}

template <class Real>
void StreamSession<Real>::apply(const std::vector<Steered>& all) {
    for (const Steered& one : all) {
        simulation_.steer(one.steering, one.swimmer);
        if (one.swimmer == 0) policy_.reset();
    }
}

template <class Real>
void StreamSession<Real>::apply(const stream::Steer& steer) {
    apply(steered_by(steer));
}

template <class Real>
void StreamSession<Real>::apply(const stream::Sense& sense) {
    simulation_.gait(sense.swimmer);  // it is there
    Sensing next = sensing_[static_cast<std::size_t>(sense.swimmer)];
    if (sense.flow) next.flow = *sense.flow;
    if (sense.within) next.within = *sense.within;
    if (sense.target) next.target = *sense.target;
    for_swimmer(sense.swimmer, sense.swimmer > 0, [&] { check_sensing(next, simulation_.model(), sense.swimmer); });
    sensing_[static_cast<std::size_t>(sense.swimmer)] = std::move(next);
    if (sense.each) sense_each_ = *sense.each;
    answer_["senses"] = senses();
}

template <class Real>
void StreamSession<Real>::apply(const stream::Water& water) {
    refuse_if_unstable();
    say(stream_water(simulation_, scene_, water.pressure));
}

template <class Real>
void StreamSession<Real>::apply(const stream::Save&) {
    held_ = std::make_shared<const std::string>(simulation_.save());
    say(stream_state(*held_));
}

/// The frame of that moment comes before the answer, as of a step.
template <class Real>
void StreamSession<Real>::apply(const stream::Restore& restore) {
    if (!held_ || held_->empty()) throw InputError("restore: there is no state; must come behind a STAT, or a save");
    if (held_->size() > stream::max_message) throw InputError("state: is larger than 1 GiB");
    if (restore.sense) check_sensing(sensing_.front(), simulation_.model());
    const bool changed = simulation_.restore(*held_, body_check(restore.bodies));
    if (!senses_fit()) forget_senses();
    restart_policy();
    if (changed) scene_changed(false);
    pace_.restart();
    due_ = true;
    offer_frame();
    if (restore.sense) answer_["senses"] = senses();
}

template <class Real>
void StreamSession<Real>::apply(const stream::Rate& rate) {
    pace_.set_rate(rate.value);
}

template <class Real>
void StreamSession<Real>::apply(const stream::Reset& reset) {
    if (reset.start)
        simulation_.reset(*reset.start);
    else
        simulation_.reset();
    scene_changed(true);
}

template <class Real>
void StreamSession<Real>::apply(const stream::NewGait& gait) {
    simulation_.gait(gait.swimmer);  // it is there
    for_swimmer(gait.swimmer, gait.swimmer > 0, [&] { simulation_.set_gait(gait.gait, gait.swimmer); });
    if (gait.swimmer == 0 && std::exchange(policy_, {})) simulation_.steer(no_steering(simulation_.model().actuators));
    scene_changed(false);
}

template <class Real>
void StreamSession<Real>::apply(const stream::Overrides& overrides) {
    const bool restarted = simulation_.merge_overrides(overrides.patch.dump(), body_check(overrides.bodies));
    if (restarted) forget_senses();
    if (restarted) restart_policy();
    scene_changed(restarted);
}

template <class Real>
void StreamSession<Real>::apply(const stream::NewScene& scene) {
    SimulationSetup setup = scene.setup;
    setup.until = settings_.until;
    simulation_.load(setup);
    policy_.reset();
    forget_senses();
    scene_changed(true);
}

/// Whether the places are those of the bodies that are there.
template <class Real>
bool StreamSession<Real>::senses_fit() const {
    if (sensing_.size() != static_cast<std::size_t>(simulation_.model().swimmers())) return false;
    try {
        for (int k = 0; k < simulation_.model().swimmers(); ++k)
            if (!simulation_.model().body_of(k).particles.empty())
                check_sensing(sensing_[static_cast<std::size_t>(k)], simulation_.model(), k);
    } catch (const InputError&) {
        return false;
    }
    return true;
}

/// The places are those of another body.
template <class Real>
void StreamSession<Real>::forget_senses() {
    sensing_.assign(static_cast<std::size_t>(simulation_.model().swimmers()), {});
    sense_each_ = false;
}

template <class Real>
void StreamSession<Real>::scene_changed(bool restarted) {
    const stream::SceneHead head{.number = ++scene_, .restarted = restarted, .fields = settings_.fields};
    ordered_json body = stream_scene(simulation_, head);
    say(stream_message("SCEN", restarted ? body : stream_scene_change(last_scene_, body)));
    last_scene_ = std::move(body);
    if (!restarted) return;
    if (policy_) policy_->restart();
    due_ = !simulation_.instability();
    dropped_ = 0;
    wall_seconds_ = 0;
    wall_frames_ = 0;
    pace_.restart();
    if (simulation_.instability()) say(stream_message("STOP", stream_stop(*simulation_.instability())));
}

/// One frame; false if the simulation became unstable.
template <class Real>
bool StreamSession<Real>::simulate() {
    const auto begin = Pace::Clock::now();
    const bool stable = simulation_.step();
    return end_frame(stable, std::chrono::duration<double>(Pace::Clock::now() - begin).count());
}

/// Books a frame, and says what has become of it.
template <class Real>
bool StreamSession<Real>::end_frame(bool stable, double wall_seconds) {
    wall_seconds_ += wall_seconds;
    ++wall_frames_;
    ++under_way_.frames;
    under_way_.stable = stable;
    if (!stable) say(stream_message("STOP", stream_stop(*simulation_.instability())));
    return stable;
}

/// Sends the present frame if there is credit; else drops it, or keeps it for later: every frame of a lossless stream,
/// and the settled start while nothing moves.
template <class Real>
void StreamSession<Real>::offer_frame() {
    if (!due_) return;
    if (credit_ == 0) {
        if (!settings_.lossless && (running_ || simulation_.frames() > 0)) drop_frame();
        return;
    }
    const stream::FrameHead head{.scene = scene_,
                                 .dropped = dropped_,
                                 .running = running(),
                                 .wall_seconds = wall_frames_ > 0 ? wall_seconds_ / wall_frames_ : 0,
                                 .fields = settings_.fields};
    if (sense_each_) say(stream_message("SENS", senses()));
    say(stream_frame(simulation_, head));
    --credit_;
    due_ = false;
    wall_seconds_ = 0;
    wall_frames_ = 0;
}

template <class Real>
void StreamSession<Real>::drop_frame() {
    ++dropped_;
    due_ = false;
}

template <class Real>
void StreamSession<Real>::refuse_if_unstable() const {
    if (simulation_.instability())
        throw InputError("the simulation is unstable since " + json(simulation_.instability()->time).dump() +
                         " s: needs reset, other overrides or another scene");
}

/// Says that the time asked for is over, when its last frame no longer waits.
template <class Real>
void StreamSession<Real>::end_if_reached() {
    if (ended_ || !at_end() || due_) return;
    ended_ = true;
    say(stream_message("STOP", stream_stop()));
}

template <class Real>
void StreamSession<Real>::refuse_if(bool over) const {
    if (over) throw InputError("the stream has reached its end, --until " + number_text(*settings_.until) + " s");
}

/// After as many frames as `natator-sim run` simulates in that time, the nearest whole number; in no other than no time
/// at least one.
template <class Real>
bool StreamSession<Real>::at_end() const {
    if (!settings_.until) return false;
    const double step = simulation_.scene().time_step;
    const double last = *settings_.until > 0 ? std::max(1.0, std::round(*settings_.until / step)) : 0;
    return std::round(simulation_.state().time / step) >= last;
}

template class StreamSession<float>;
template class StreamSession<double>;

}  // namespace natator::cli
