#pragma once

#include <optional>
#include <string>
#include <vector>

#include "natator/batch.h"

namespace natator::bench {

/// Gaits about that of the scene, each a little faster and weaker than the one before.
std::vector<BatchMember> batch_members(const Scene& scene, int count);

/// A batch of evaluations that was computed some times on a GPU.
struct TimedBatch {
    double whole = 0;   ///< s from the gaits to the evaluations with their hashes, the least
    BatchTimes device;  ///< the least of the kernels' time; of settling the most, as it is done once
    std::string hash;   ///< of the evaluations' hashes
    std::optional<Instability> instability;  ///< of one that came to no end: then the times mean nothing
};

/// Throws std::runtime_error when two runs differ in a bit.
TimedBatch time_batch(const Scene& scene, const std::vector<BatchMember>& members, BatchOptions options, int repeats);

/// Name of the GPU. Throws NoDevice without it.
std::string gpu_name(int device);

}  // namespace natator::bench
