#pragma once

#include <string>
#include <vector>

namespace natator::test {

/// A gait of creature 1.
inline constexpr const char* gait = R"({"frequency":1.861,"amplitude":[0.973,0.69],"phase":[0,0.648]})";

/// Path of natator-sim.
const char* simulator();

/// Whether what is tested is built with sanitizers.
bool sanitized();

/// What a finished program left behind.
struct Outcome {
    int exit_code = -1;  ///< -1 if a signal ended it
    std::string out;
    std::string err;
};

/// Runs natator-sim with `arguments`, `input` on its standard input, and waits for its end.
/// Its standard output goes to `out_path` instead of Outcome::out if that is given.
Outcome run_simulator(const std::vector<std::string>& arguments, const std::string& input = "",
                      const std::string& out_path = "");

/// The same after this text of a shell, such as "ulimit -f 8".
Outcome run_limited(const std::string& limits, const std::vector<std::string>& arguments,
                    const std::string& input = "");

/// The same with so many bytes of address space and no more.
Outcome run_with_memory(std::size_t bytes, const std::vector<std::string>& arguments, const std::string& input);

/// Number of lines in `text`, counting one without an end.
int lines(const std::string& text);

}  // namespace natator::test
