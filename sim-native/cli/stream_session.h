#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "natator/simulation.h"
#include "pace.h"
#include "policy.h"
#include "protocol/stream.h"

namespace natator::cli {

/// How a scene is streamed.
struct StreamSettings {
    stream::Fields fields;
    int every = 1;                 ///< frames of which one is offered
    double rate = 1;               ///< simulated seconds per second of wall time, at most; 0 = as fast as possible
    std::optional<double> until;   ///< s
    bool lossless = false;         ///< waits for credit instead of dropping frames
    bool paused = false;           ///< at first
    std::optional<Policy> policy;  ///< that drives the swimmer, until another gait, steering or scene
};

/// Runs a scene, carries out commands and says messages (sim-native/protocol/stream.md). One thread at a time.
template <class Real>
class StreamSession {
public:
    /// Settles the scene. Throws InputError.
    StreamSession(const SimulationSetup& setup, const Execution& execution, const StreamSettings& settings);

    /// Goes to a saved moment, before it begins. Throws InputError.
    void restore(const std::string& saved) {
        simulation_.restore(saved);
        restart_policy();
    }
    /// Says what scene it is.
    void begin() { scene_changed(true); }
    /// A command, and its answer.
    void carry_out(const nlohmann::json& command);
    /// An action, and what came of it.
    stream::Outcome act(const stream::Action& action);
    /// The same in parts, for swims that go on together: what comes before its frames; the simulation to be advanced by
    /// the next, null when there is none; what follows that; what follows the last. The action must stay until then.
    void begin_act(const stream::Action& action);
    Simulation<Real>* next_of_act();
    void end_frame_of_act(bool stable, double wall_seconds);
    stream::Outcome end_act();
    /// What `restore` is to go to.
    void hold(std::shared_ptr<const std::string> state) { held_ = std::move(state); }
    /// Says the present frame if there is credit, and whether the end is reached.
    void offer() {
        offer_frame();
        end_if_reached();
    }
    /// When it would go on by itself; none while it stands still.
    std::optional<Pace::Clock::time_point> next_frame() const {
        return running() && !due_ && !ended_ ? std::optional(pace_.next()) : std::nullopt;
    }
    /// Does so, by one frame.
    void go_on();
    bool ended() const { return ended_; }  ///< no command does anything more
    std::string take_messages() { return std::exchange(messages_, {}); }

private:
    void apply(const stream::Credit& credit);
    void apply(const stream::Run&);
    void apply(const stream::Pause&);
    void apply(const stream::Step& step);
    void apply(const stream::Water& water);
    void apply(const stream::Save&);
    void apply(const stream::Restore& restore);
    void apply(const stream::Rate& rate);
    void apply(const stream::Reset& reset);
    void apply(const stream::NewGait& gait);
    void apply(const stream::Steer& steer);
    void apply(const stream::Sense& sense);
    void apply(const stream::Overrides& overrides);
    void apply(const stream::NewScene& scene);

    void say(const std::string& message) { messages_ += message; }
    /// What a command asks of a swimmer.
    struct Steered {
        int swimmer = 0;
        Steering steering;
    };
    std::vector<stream::Steer> by_swimmer(const stream::Steer& steer, const std::string& row) const;
    std::vector<Steered> steered_by(const stream::Steer& steer, const std::string& row = {}) const;
    void apply(const std::vector<Steered>& all);
    std::vector<std::vector<Steered>> checked(const stream::Step& step) const;
    void begin_step(const stream::Step& step);
    bool steer_next_frame();
    void begin_policy();
    void restart_policy();
    void drive_by_policy();
    bool end_frame(bool stable, double wall_seconds);
    void end_step();
    /// Does something of the action that is under way, unless it has been refused.
    template <class Work>
    void or_refuse(const Work& work);
    nlohmann::ordered_json senses() const { return stream_senses(simulation_, sensing_); }
    bool senses_fit() const;
    void forget_senses();
    void scene_changed(bool restarted);
    bool simulate();
    void offer_frame();
    void drop_frame();
    void refuse_if_unstable() const;
    void refuse_if(bool over) const;
    void end_if_reached();
    bool running() const { return running_ && !simulation_.instability(); }
    bool at_end() const;

    StreamSettings settings_;
    Simulation<Real> simulation_;
    Pace pace_;
    bool running_;
    std::vector<Sensing> sensing_;             ///< by swimmer
    std::optional<Policy> policy_;             ///< that drives the first swimmer
    bool sense_each_ = false;                  ///< a SENS before every frame
    nlohmann::ordered_json answer_;            ///< of the command that is carried out
    std::shared_ptr<const std::string> held_;  ///< the last STAT, of either direction; null before it
    std::string messages_;                     ///< that nobody has taken
    int credit_ = 0;                           ///< frames that may be sent
    bool ended_ = false;                       ///< the last STOP is out: no command does anything more
    bool due_ = false;                         ///< the present frame is still to be offered
    std::uint32_t scene_ = 0;                  ///< number of the last SCEN
    nlohmann::ordered_json last_scene_;        ///< the whole of it, also where only changes were sent
    std::uint32_t dropped_ = 0;                ///< frames since the start
    double wall_seconds_ = 0;                  ///< of the frames since the last one sent
    int wall_frames_ = 0;
    /// The step that is under way, if there is one.
    struct {
        const stream::Step* step = nullptr;
        std::size_t frames = 0;  ///< that are done
        bool stable = true;
        std::vector<std::vector<Steered>> rows;  ///< what is asked of swimmers: nothing, once, or before each frame
    } under_way_;
    stream::Outcome outcome_;  ///< of the action that is under way
};

extern template class StreamSession<float>;
extern template class StreamSession<double>;

}  // namespace natator::cli
