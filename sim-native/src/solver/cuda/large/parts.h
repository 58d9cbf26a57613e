#pragma once

#include <algorithm>

namespace natator::cuda {

/// Members that are computed part by part, in parts of at most `most` and of nearly one size, and these in turn by streams side
/// by side: part k by stream k % streams.
struct Parts {
    int members, size, streams;

    Parts(int all, int most, int most_streams)
        : members(all), size(ceiling(all, ceiling(all, most))), streams(std::min(count(), most_streams)) {}

    int count() const { return ceiling(members, size); }
    int first(int part) const { return part * size; }
    int size_of(int part) const { return std::min(size, members - first(part)); }

    /// So many that each stream has a part, but at most so many.
    static int most_of(int all, int streams, int most) { return std::min(ceiling(all, streams), most); }

private:
    static int ceiling(int dividend, int divisor) { return (dividend + divisor - 1) / divisor; }
};

}  // namespace natator::cuda
