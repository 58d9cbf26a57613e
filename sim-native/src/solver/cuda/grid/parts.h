#pragma once

#include <algorithm>

namespace natator::cuda {

/// Members that are computed part by part, in parts of at most `most` and of nearly one size, and these in turn by
/// streams side by side: part k by stream k % streams. Each stream has as many parts as the others, where there are
/// members enough, since the GPU waits for the last.
struct Parts {
    int members, count, streams;

    Parts(int all, int max_size, int max_streams)
        : members(all),
          count(std::min(all, ceiling(ceiling(all, max_size), max_streams) * max_streams)),
          streams(std::min(count, max_streams)) {}

    int first(int part) const { return part * (members / count) + std::min(part, members % count); }
    int size_of(int part) const { return first(part + 1) - first(part); }
    /// Of the largest.
    int size() const { return size_of(0); }

private:
    static int ceiling(int dividend, int divisor) { return (dividend + divisor - 1) / divisor; }
};

}  // namespace natator::cuda
