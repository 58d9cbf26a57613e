// The simulator inside a web page: what `natator-sim stream` is to a program, without a process and without threads.
// The script that loads this module gets the messages of sim-native/protocol/stream.md by its function
// `message(bytes)`.
#include <emscripten.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>

#include "base/strict_json.h"
#include "base/text.h"
#include "natator/error.h"
#include "protocol/protocol.h"
#include "stream_session.h"

namespace natator::cli {
namespace {

EM_JS(void, give_out, (const char* bytes, int size), { Module['message'](HEAPU8.slice(bytes, bytes + size)); });

void send(const std::string& message) {
    give_out(message.data(), static_cast<int>(message.size()));
}

std::optional<StreamSession<float>> session;

/// Begins with the scene of a command `scene`.
void start(const nlohmann::json& command) {
    const StreamCommand parsed = parse_stream_command(command);
    const auto* const scene = std::get_if<stream::NewScene>(&parsed);
    if (!scene) throw InputError("command: do must be \"scene\" at first");
    const StreamSettings settings{.fields = {.position = true, .velocity = true, .force = true}, .paused = true};
    session.emplace(scene->setup, Execution{.forces = true}, settings);
    session->begin();
}

/// Gives out the present frame if there is credit, and all that is said.
void offer() {
    session->offer();
    const std::string all = session->take_messages();
    for (std::size_t at = 0; at < all.size();) {
        std::uint32_t body;
        std::memcpy(&body, all.data() + at + stream::message_head - sizeof body, sizeof body);
        send(all.substr(at, stream::message_head + body));
        at += stream::message_head + body;
    }
}

}  // namespace
}  // namespace natator::cli

extern "C" {

/// Carries out one command, a line of JSON, and answers it. The first one is `scene`; it begins paused.
EMSCRIPTEN_KEEPALIVE void natator_command(const char* line) {
    using namespace natator;
    using namespace natator::cli;
    nlohmann::ordered_json answer = {{"id", nullptr}};
    try {
        const nlohmann::json command = parse_json(line, "command");
        answer["id"] = request_id(command);
        if (session) {
            session->carry_out(command);
            offer();
            return;
        }
        start(command);
        offer();
        answer["ok"] = true;
    } catch (const std::exception& error) {
        answer["error"] = message_of(error);
    }
    send(stream_message("ANSW", answer));
}

/// Simulates a frame if it is time for one, and gives it out if there is credit. Milliseconds until the next; below 0:
/// none before another command.
EMSCRIPTEN_KEEPALIVE double natator_advance() {
    using namespace natator::cli;
    if (!session) return -1;
    auto next = session->next_frame();
    if (next && *next <= Pace::Clock::now()) {
        session->go_on();
        offer();
        next = session->next_frame();
    }
    if (!next) return -1;
    return std::max(0.0, std::chrono::duration<double, std::milli>(*next - Pace::Clock::now()).count());
}
}
