// The one source of the tests that each build compiles for itself: it knows what is tested.
#include "child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace natator::test {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporary() {
    File file(std::tmpfile(), &std::fclose);
    if (!file) throw std::runtime_error("no temporary file");
    return file;
}

std::string content(std::FILE* file) {
    std::rewind(file);
    std::string text;
    char buffer[4096];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
    return text;
}

Outcome run_program(const char* program, const std::vector<std::string>& arguments, const std::string& input,
                    const std::string& out_path) {
    const File in = temporary(), out = temporary(), err = temporary();
    std::fwrite(input.data(), 1, input.size(), in.get());
    std::rewind(in.get());

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(err.get()), STDERR_FILENO);
    if (out_path.empty()) {
        posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
    } else {
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_path.c_str(), O_WRONLY, 0);
    }
    std::vector<char*> argv{const_cast<char*>(program)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    const int failed = posix_spawn(&child, program, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error(std::string("cannot start ") + program);

    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out.get()), content(err.get())};
}

}  // namespace

const char* simulator() {
    return NATATOR_SIM_PATH;
}

bool sanitized() {
#ifdef NATATOR_SANITIZED
    return true;
#else
    return false;
#endif
}

Outcome run_simulator(const std::vector<std::string>& arguments, const std::string& input,
                      const std::string& out_path) {
    return run_program(simulator(), arguments, input, out_path);
}

Outcome run_limited(const std::string& limits, const std::vector<std::string>& arguments, const std::string& input) {
    std::vector<std::string> all{"-c", limits + " && exec \"$0\" \"$@\"", simulator()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_program("/bin/sh", all, input, "");
}

Outcome run_with_memory(std::size_t bytes, const std::vector<std::string>& arguments, const std::string& input) {
    return run_limited("ulimit -v " + std::to_string(bytes >> 10), arguments, input);
}

int lines(const std::string& text) {
    int count = 0;
    for (const char c : text) count += c == '\n' ? 1 : 0;
    return count + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

}  // namespace natator::test
