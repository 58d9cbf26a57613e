#include "timed_batch.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <filesystem>
#include <limits>
#include <random>
#include <stdexcept>

#include "base/fnv1a.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/settled_state_cache.h"
#include "speed.h"

namespace natator::bench {
namespace {

std::string hash_of(const std::vector<Evaluation>& evaluations) {
    Fnv1a hash;
    for (const Evaluation& evaluation : evaluations) hash.add(std::bit_cast<double>(evaluation.hash));
    return hash_text(hash.value());
}

/// Settled starts of one measurement, so that its first repeat alone settles.
class OwnStarts {
public:
    OwnStarts()
        : cache_(std::filesystem::temp_directory_path() / ("natator-bench-" + std::to_string(std::random_device{}()))) {
    }
    ~OwnStarts() {
        std::error_code error;
        std::filesystem::remove_all(cache_.folder(), error);
    }
    const SettledStateCache* cache() const { return &cache_; }

private:
    SettledStateCache cache_;
};

}  // namespace

std::vector<BatchMember> batch_members(const Scene& scene, int count) {
    std::vector<BatchMember> members;
    for (int k = 0; k < count; ++k) {
        Gait gait = speed_gait(scene);
        const double part = static_cast<double>(k) / count;
        gait.frequency *= 1 + 0.1 * part;
        for (double& amplitude : gait.amplitude) amplitude *= 1 - 0.5 * part;
        members.push_back({gait, {}});
    }
    return members;
}

TimedBatch time_batch(const Scene& scene, const std::vector<BatchMember>& members, BatchOptions options, int repeats) {
    using Clock = std::chrono::steady_clock;
    constexpr double never = std::numeric_limits<double>::infinity();
    const OwnStarts starts;
    options.starts = starts.cache();
    TimedBatch timed{.whole = never, .device = {.settling = 0, .kernel = never}, .hash = {}, .instability = {}};
    for (int k = 0; k < repeats; ++k) {
        BatchTimes times;
        options.times = &times;
        const auto start = Clock::now();
        const std::vector<Evaluation> evaluations = evaluate_on_gpu(scene, members, options);
        timed.whole = std::min(timed.whole, std::chrono::duration<double>(Clock::now() - start).count());
        timed.device.kernel = std::min(timed.device.kernel, times.kernel);
        timed.device.settling = std::max(timed.device.settling, times.settling);
        timed.device.memory = times.memory;
        timed.device.at_a_time = times.at_a_time;
        for (const Evaluation& evaluation : evaluations)
            if (evaluation.instability) timed.instability = evaluation.instability;
        const std::string hash = hash_of(evaluations);
        if (!timed.hash.empty() && hash != timed.hash)
            throw std::runtime_error("two runs differ: " + timed.hash + " and " + hash);
        timed.hash = hash;
    }
    return timed;
}

std::string gpu_name(int device) {
    const std::vector<Device> devices = cuda_devices();
    if (device >= static_cast<int>(devices.size()))
        throw NoDevice("bench: device " + std::to_string(device) + ": no such device here");
    return devices[static_cast<std::size_t>(device)].name;
}

}  // namespace natator::bench
