#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "line_queue.h"
#include "stream_session.h"

namespace natator::cli {

/// How many swims a stream has, and how many of them go on at a time, each in a thread of its own.
struct BatchSize {
    int swims = 1, threads = 1;
};

/// Swims side by side, one or many: reads commands and hands them to those that they are for, and writes what these say
/// (sim-native/protocol/stream.md). What a swim does depends on its own commands alone.
template <class Real>
class StreamBatch {
public:
    /// Settles the scene, for each. Throws InputError.
    StreamBatch(const SimulationSetup& setup, const Execution& execution, const StreamSettings& settings,
                BatchSize size);

    /// Begins all at a saved moment instead of the settled start. Throws InputError.
    void restore(const std::string& saved);

    /// Returns at the end of the commands, or when all have reached the time asked for. Throws std::runtime_error when
    /// standard output can't be written.
    void run(LineQueue& commands);

private:
    using Swims = std::vector<std::size_t>;

    void take(const std::string& line);
    void hand_over(nlohmann::json command);
    void carry_out_waiting();
    void act(std::string_view message);
    void act_together(const stream::Actions& actions, std::vector<stream::Outcome>& outcomes);
    void act_together(Swims swims, const stream::Actions& actions, std::vector<stream::Outcome>& outcomes);
    void refuse(const nlohmann::json& id, const std::string& why);
    void write();
    /// Calls work(swim) for these, as many at a time as there are threads.
    template <class Work>
    void at_once(const Swims& swims, const Work& work);
    /// Those of which this is true.
    template <class Test>
    Swims those(const Test& test) const;
    bool single() const { return swims_.size() == 1; }

    BatchSize size_;
    bool together_;  ///< on a GPU that they share
    std::vector<std::unique_ptr<StreamSession<Real>>> swims_;
    std::vector<std::vector<nlohmann::json>> waiting_;  ///< commands, by swim
    std::mutex beginning_;                              ///< of a group of `act_together`
    std::string own_;                                   ///< messages of no swim that are to be written
    std::size_t told_ = SIZE_MAX;                       ///< swim of the last message
};

extern template class StreamBatch<float>;
extern template class StreamBatch<double>;

}  // namespace natator::cli
