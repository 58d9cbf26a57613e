#include "stream_client.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "child_process.h"

namespace natator::test {
namespace {

constexpr int patience = 600'000;  // ms; only failures wait so long

/// Both ends are closed in other children.
std::pair<int, int> make_pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    return {ends[0], ends[1]};
}

void close_file(int& file) {
    if (file >= 0) ::close(file);
    file = -1;
}

/// Takes values one after another.
class Taker {
public:
    explicit Taker(const std::string& bytes) : bytes_(bytes) {}

    template <class T>
    T take() {
        if (at_ + sizeof(T) > bytes_.size()) throw std::runtime_error("frame is too short");
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    std::vector<float> take_floats(std::size_t count) {
        std::vector<float> values(count);
        for (float& value : values) value = take<float>();
        return values;
    }
    bool empty() const { return at_ == bytes_.size(); }

private:
    const std::string& bytes_;
    std::size_t at_ = 0;
};

}  // namespace

StreamFrame::StreamFrame(const std::string& body, const nlohmann::json& about) {
    Taker bytes(body);
    for (std::uint32_t* value : {&scene, &number, &dropped, &flags}) *value = bytes.take<std::uint32_t>();
    for (double* value : {&time, &wall, &distance}) *value = bytes.take<double>();
    body_velocity = bytes.take_floats(3);
    laws = bytes.take_floats(4);
    if (bytes.take<std::uint32_t>() != 0) throw std::runtime_error("frame has something at byte 68");
    drive = bytes.take_floats(about.at("actuators"));
    const std::size_t particles = about.at("particles");
    for (const nlohmann::json& field : about.at("fields")) {
        if (field == "position") position = bytes.take_floats(3 * particles);
        if (field == "velocity") velocity = bytes.take_floats(3 * particles);
        if (field == "density") density = bytes.take_floats(particles);
        if (field == "force") force = bytes.take_floats(3 * particles);
    }
    if (!bytes.empty()) throw std::runtime_error("frame is too long");
    if (scene != about.at("number")) throw std::runtime_error("frame is of another scene than the last");
}

StreamClient::StreamClient(const std::vector<std::string>& arguments) {
    ::signal(SIGPIPE, SIG_IGN);
    const auto [child_input, input] = make_pipe();
    const auto [output, child_output] = make_pipe();
    input_ = input;
    output_ = output;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, child_input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, child_output, STDOUT_FILENO);
    std::vector<char*> argv{const_cast<char*>(simulator()), const_cast<char*>("stream")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const int failed = posix_spawn(&pid_, simulator(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(child_input);
    ::close(child_output);
    if (failed != 0) throw std::runtime_error(std::string("cannot start ") + simulator());
}

StreamClient::~StreamClient() {
    close_input();
    close_output();
    if (pid_ == 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

void StreamClient::send_bytes(const std::string& text) {
    for (std::size_t sent = 0; sent < text.size();) {
        const ssize_t count = ::write(input_, text.data() + sent, text.size() - sent);
        if (count < 0) throw std::runtime_error("the simulator takes no more commands");
        sent += static_cast<std::size_t>(count);
    }
}

std::size_t StreamClient::try_send(const std::string& text) {
    ::fcntl(input_, F_SETFL, ::fcntl(input_, F_GETFL) | O_NONBLOCK);
    const ssize_t count = ::write(input_, text.data(), text.size());
    ::fcntl(input_, F_SETFL, ::fcntl(input_, F_GETFL) & ~O_NONBLOCK);
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool StreamClient::read(char* to, std::size_t size) {
    for (std::size_t done = 0; done < size;) {
        pollfd file{output_, POLLIN, 0};
        if (::poll(&file, 1, patience) == 0) throw std::runtime_error("no message for ten minutes");
        const ssize_t count = ::read(output_, to + done, size - done);
        if (count < 0) throw std::runtime_error("messages cannot be read");
        if (count == 0 && done == 0) return false;
        if (count == 0) throw std::runtime_error("half a message");
        done += static_cast<std::size_t>(count);
    }
    return true;
}

std::optional<StreamMessage> StreamClient::next() {
    char head[8];
    if (!read(head, sizeof head)) return std::nullopt;
    std::uint32_t length = 0;
    std::memcpy(&length, head + 4, sizeof length);
    StreamMessage message{std::string(head, 4), std::string(length, '\0')};
    if (length % 4 != 0) throw std::runtime_error("message whose length is not a multiple of 4");
    if (length > 0 && !read(message.body.data(), length)) throw std::runtime_error("head without a body");
    if (message.letters == "SCEN") take_scene(message.value());
    return message;
}

/// One that goes on tells only what has changed.
void StreamClient::take_scene(const nlohmann::json& body) {
    if (body.at("restarted") == true) {
        scene_ = body;
    } else {
        scene_.update(body);
    }
}

nlohmann::json StreamClient::expect(const std::string& letters) {
    const auto message = next();
    if (!message || message->letters != letters)
        throw std::runtime_error("expected " + letters + ", got " + (message ? message->letters : "the end"));
    return message->value();
}

StreamFrame StreamClient::frame() {
    const auto message = next();
    if (!message || message->letters != "FRAM")
        throw std::runtime_error("expected a frame, got " + (message ? message->letters + message->body : "the end"));
    return {message->body, scene_};
}

nlohmann::json StreamClient::ask(nlohmann::json command) {
    command["id"] = ++last_id_;
    send(command);
    while (const auto message = next()) {
        if (message->letters == "ANSW" && message->value().at("id") == last_id_) return message->value();
        passed_.push_back(*message);
    }
    throw std::runtime_error("no answer");
}

std::vector<StreamMessage> StreamClient::passed() {
    return std::exchange(passed_, {});
}

void StreamClient::close_input() {
    close_file(input_);
}

void StreamClient::close_output() {
    close_file(output_);
}

int StreamClient::wait() {
    int status = 0;
    for (int waited = 0; ::waitpid(pid_, &status, WNOHANG) == 0; waited += 10) {
        if (waited > patience) throw std::runtime_error("the simulator does not end");
        ::usleep(10'000);
    }
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace natator::test
