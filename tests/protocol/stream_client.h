#pragma once

#include <sys/types.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace natator::test {

/// A message of natator-sim stream.
struct StreamMessage {
    std::string letters;
    std::string body;

    nlohmann::json value() const { return nlohmann::json::parse(body); }
};

/// The body of a FRAM, taken apart by the table of stream.md.
struct StreamFrame {
    std::uint32_t scene = 0, number = 0, dropped = 0, flags = 0;
    double time = 0, wall = 0, distance = 0;
    std::vector<float> body_velocity, laws, drive;
    std::vector<float> position, velocity, density, force;  ///< empty where the scene's `fields` lack it

    /// Throws std::runtime_error when the size is not that which `scene`, a SCEN, gives.
    StreamFrame(const std::string& body, const nlohmann::json& scene);
};

/// A running `natator-sim stream`, killed at the latest when this goes out of scope. Waiting for more than ten minutes
/// throws std::runtime_error.
class StreamClient {
public:
    explicit StreamClient(const std::vector<std::string>& arguments);
    ~StreamClient();
    StreamClient(const StreamClient&) = delete;
    StreamClient& operator=(const StreamClient&) = delete;

    void send(const nlohmann::json& command) { send_line(command.dump()); }
    void send_line(const std::string& line) { send_bytes(line + "\n"); }
    void send_bytes(const std::string& bytes);
    /// Writes as much of the text as the pipe takes without waiting; the number of bytes.
    std::size_t try_send(const std::string& text);

    /// The next message; none at the end of the output.
    std::optional<StreamMessage> next();
    /// The next message, which must be of this kind.
    nlohmann::json expect(const std::string& letters);
    /// The next message, which must be a frame of the last SCEN.
    StreamFrame frame();
    /// Sends a command and passes over other messages to its answer.
    nlohmann::json ask(nlohmann::json command);
    /// The messages that `ask` passed over, since the last call.
    std::vector<StreamMessage> passed();

    const nlohmann::json& scene() const { return scene_; }  ///< the last SCEN, completed by those before

    void close_input();
    void close_output();
    int wait();  ///< exit code; -1 if a signal ended it
    pid_t pid() const { return pid_; }

private:
    bool read(char* to, std::size_t size);
    void take_scene(const nlohmann::json& body);

    pid_t pid_ = 0;
    int input_ = -1, output_ = -1;
    int last_id_ = 1000;
    nlohmann::json scene_;
    std::vector<StreamMessage> passed_;
};

}  // namespace natator::test
