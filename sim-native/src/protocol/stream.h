#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/field.h"
#include "natator/measure.h"
#include "natator/simulation.h"

/// The protocol of `natator-sim stream`: commands in, messages out (sim-native/protocol/stream.md).
namespace natator {

namespace stream {

/// The commands. Those that need no more than their name are empty.
struct Credit {
    int frames = 1;
};
struct Run {};
struct Pause {};
/// Actuator values, or changes of what the gait gives; a list that is left out leaves that part of it as it is.
struct Steer {
    std::optional<int> swimmer;                ///< none: the first, or all, one after the other, by how many values
    std::optional<std::vector<double>> drive;  ///< then the others are not there
    std::optional<std::vector<double>> scale, offset;
};
struct Step {
    int frames = 1;
    std::vector<Steer> steer;  ///< before the first frame, or one for each; empty: as before
    bool sense = false;        ///< the answer has the senses at the end
};
struct Sense {
    int swimmer = 0;
    std::optional<std::vector<SkinPlace>> flow;
    std::optional<double> within;
    std::optional<std::optional<Eigen::Vector3d>> target;  ///< null takes it away
    std::optional<bool> each;                              ///< a SENS with every frame that is sent
};
struct Water {  ///< a WATR of the present state
    bool pressure = false;
};
struct Save {};  ///< a STAT of the present moment
/// What each swimmer's body must have, so that who reads and drives it need not change: else nothing does.
struct Body {
    int actuators = 0;
    int slices = 0;  ///< at least
};
using Bodies = std::optional<std::vector<Body>>;
struct Restore {         ///< to the last STAT, of either direction
    bool sense = false;  ///< the answer has the senses
    Bodies bodies{};
};
struct Rate {
    double value = 1;  ///< simulated seconds per second of wall time; 0 = as fast as possible
};
struct Reset {
    std::optional<int> start;
};
struct NewGait {
    Gait gait;
    int swimmer = 0;
};
struct Overrides {
    nlohmann::json patch;
    Bodies bodies{};
};
struct NewScene {
    SimulationSetup setup;
};

inline constexpr int max_credit = 1000;              ///< frames
inline constexpr int max_step = 1000;                ///< frames
inline constexpr std::size_t max_command = 1 << 20;  ///< bytes
inline constexpr std::size_t max_message = 1 << 30;  ///< bytes of the body of one that comes in

// Messages that come in stand among the commands. They have the form of those that go out: letters, length, body.
inline constexpr std::size_t message_head = 8;  ///< bytes before the body
inline constexpr std::string_view state_letters = "STAT", action_letters = "ACTS";

/// What one of many swims is told to do.
struct Action {
    std::optional<Step> step;  ///< none: it stands still
    std::string refusal;       ///< why it can't be done; empty: it can
};

/// Those of all swims, of an ACTS.
struct Actions {
    std::uint32_t id = 0;
    std::vector<Action> of;
};

/// What has come of it.
struct Outcome {
    enum Status : std::uint32_t { still, stepped, unstable, refused };
    Status status = still;
    std::string refusal;
    std::vector<double> senses;  ///< of the present moment; empty without a swimmer
};

/// The largest batch.
inline constexpr int max_swims = 4096;

/// Whether simulated seconds per second of wall time may be limited to this: 0 (no limit) or in [0.001, 1000].
bool is_rate(double value);

/// What a frame holds of each particle, in the order of these members.
struct Fields {
    bool position = true, velocity = false, density = false, force = false;
};

/// What a SCEN says beyond the simulation.
struct SceneHead {
    std::uint32_t number = 1;  ///< of SCEN messages
    bool restarted = true;
    Fields fields;
};

/// What a FRAM says beyond the simulation.
struct FrameHead {
    std::uint32_t scene = 1;    ///< number of its SCEN
    std::uint32_t dropped = 0;  ///< frames since the start
    bool running = false;
    double wall_seconds = 0;  ///< for one frame
    Fields fields;
};

}  // namespace stream

using StreamCommand = std::variant<stream::Credit, stream::Run, stream::Pause, stream::Step, stream::Rate,
                                   stream::Reset, stream::NewGait, stream::Steer, stream::Sense, stream::Water,
                                   stream::Save, stream::Restore, stream::Overrides, stream::NewScene>;

/// Reads a command. Throws InputError naming the field, its value and what is allowed. Whether a gait or a scene can be
/// used is for the simulation to see.
StreamCommand parse_stream_command(const nlohmann::json& value);
/// "left", "right", "above" or "below". Throws InputError.
SkinPlace::Side read_skin_side(const nlohmann::json& value, const fields::Place& at);

/// A message with JSON in it, as bytes. `letters` are its four letters.
std::string stream_message(std::string_view letters, const nlohmann::ordered_json& body);

/// The body of SCEN.
template <class Real>
nlohmann::ordered_json stream_scene(const Simulation<Real>& simulation, const stream::SceneHead& head);

/// The body of a SCEN that goes on: its number, and what differs from the one before; null where
/// there is none any more. Both are bodies of `stream_scene`.
nlohmann::ordered_json stream_scene_change(const nlohmann::ordered_json& before, const nlohmann::ordered_json& now);

/// The FRAM of the present state, as bytes.
template <class Real>
std::string stream_frame(Simulation<Real>& simulation, const stream::FrameHead& head);

/// The WATR of the present state, as bytes. `scene`: number of its SCEN. Throws InputError as Simulation::water, and
/// for the pressure in scheme flex.
template <class Real>
std::string stream_water(const Simulation<Real>& simulation, std::uint32_t scene, bool pressure);

/// A saved moment as a STAT, as bytes.
std::string stream_state(std::string_view saved);

/// What the swimmers sense, in SENS and in answers. `sensing`: by swimmer.
template <class Real>
nlohmann::ordered_json stream_senses(const Simulation<Real>& simulation, const std::vector<Sensing>& sensing);

/// The senses as an OBSV has them; none where there is no swimmer.
template <class Real>
std::vector<double> stream_sense_numbers(const Simulation<Real>& simulation, const std::vector<Sensing>& sensing);

/// Reads an ACTS, header and all. Throws InputError where it is not one of so many swims; what is wrong with one of
/// them is in its Action.
stream::Actions parse_stream_actions(std::string_view message, std::size_t swims);

/// The OBSV of these, and the SWIM before messages of one swim, as bytes.
std::string stream_outcomes(std::uint32_t id, const std::vector<stream::Outcome>& outcomes);
std::string stream_swim(std::uint32_t swim);

/// The bodies of STOP: the time asked for is reached; the simulation has become unstable.
nlohmann::ordered_json stream_stop();
nlohmann::ordered_json stream_stop(const Instability& instability);

extern template nlohmann::ordered_json stream_scene(const Simulation<float>&, const stream::SceneHead&);
extern template nlohmann::ordered_json stream_scene(const Simulation<double>&, const stream::SceneHead&);
extern template nlohmann::ordered_json stream_senses(const Simulation<float>&, const std::vector<Sensing>&);
extern template nlohmann::ordered_json stream_senses(const Simulation<double>&, const std::vector<Sensing>&);
extern template std::vector<double> stream_sense_numbers(const Simulation<float>&, const std::vector<Sensing>&);
extern template std::vector<double> stream_sense_numbers(const Simulation<double>&, const std::vector<Sensing>&);
extern template std::string stream_water(const Simulation<float>&, std::uint32_t, bool);
extern template std::string stream_water(const Simulation<double>&, std::uint32_t, bool);
extern template std::string stream_frame(Simulation<float>&, const stream::FrameHead&);
extern template std::string stream_frame(Simulation<double>&, const stream::FrameHead&);

}  // namespace natator
