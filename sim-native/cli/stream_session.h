#pragma once

#include <functional>
#include <optional>
#include <string>

#include "line_queue.h"
#include "natator/simulation.h"
#include "pace.h"
#include "protocol/stream.h"

namespace natator::cli {

/// How a scene is streamed.
struct StreamSettings {
    stream::Fields fields;
    int every = 1;                ///< frames of which one is offered
    double rate = 1;              ///< simulated seconds per second of wall time, at most; 0 = as fast as possible
    std::optional<double> until;  ///< s
    bool lossless = false;        ///< waits for credit instead of dropping frames
    bool paused = false;          ///< at first
};

/// Runs a scene, carries out commands and gives out messages (sim-native/protocol/stream.md).
template <class Real>
class StreamSession {
public:
    /// Takes a message, as bytes. What it throws ends the call that gave it out.
    using Output = std::function<void(const std::string&)>;

    /// Settles the scene. Throws InputError.
    StreamSession(const SimulationSetup& setup, const Execution& execution, const StreamSettings& settings,
                  Output output);

    /// Returns at the end of the commands, or when the time asked for is reached.
    void run(LineQueue& commands);

    // The parts of `run`, for who has no thread to wait with.

    /// Gives out the first SCEN; to be called first.
    void begin();
    /// Carries out one command, a line of JSON, and answers it.
    void carry_out(const std::string& line);
    /// Gives out the present frame if it is due and there is credit. False once the time asked for is reached.
    bool offer();
    /// When the next frame may be simulated; none before another command.
    std::optional<Pace::Clock::time_point> next_frame() const;
    /// Simulates one frame.
    void simulate_frame();

private:
    void apply(const stream::Credit& credit);
    void apply(const stream::Run&);
    void apply(const stream::Pause&);
    void apply(const stream::Step& step);
    void apply(const stream::Water&);
    void apply(const stream::Rate& rate);
    void apply(const stream::Reset& reset);
    void apply(const stream::NewGait& gait);
    void apply(const stream::Steer& steer);
    void apply(const stream::Sense& sense);
    void apply(const stream::Overrides& overrides);
    void apply(const stream::NewScene& scene);

    Steering steering_of(const stream::Steer& steer) const;
    void check(const stream::Step& step) const;
    nlohmann::ordered_json senses() const { return stream_senses(simulation_, sensing_); }
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
    Output output_;
    Simulation<Real> simulation_;
    Pace pace_;
    bool running_;
    Sensing sensing_;
    bool sense_each_ = false;            ///< a SENS before every frame
    nlohmann::ordered_json answer_;      ///< of the command that is carried out
    int credit_ = 0;                     ///< frames that may be sent
    bool ended_ = false;                 ///< the last STOP is out: no command does anything more
    bool due_ = false;                   ///< the present frame is still to be offered
    std::uint32_t scene_ = 0;            ///< number of the last SCEN
    nlohmann::ordered_json last_scene_;  ///< the whole of it, also where only changes were sent
    std::uint32_t dropped_ = 0;          ///< frames since the start
    double wall_seconds_ = 0;            ///< of the frames since the last one sent
    int wall_frames_ = 0;
};

extern template class StreamSession<float>;
extern template class StreamSession<double>;

}  // namespace natator::cli
