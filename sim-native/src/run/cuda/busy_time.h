#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace natator::cuda {

using HostTime = std::chrono::steady_clock::time_point;

/// From `begin` to `end`.
struct Span {
    HostTime begin, end;
};

/// How long at least one of the spans lasts, s: those of streams side by side overlap as much as they come to.
inline double busy_seconds(std::vector<Span> spans) {
    std::ranges::sort(spans, {}, &Span::begin);
    std::chrono::duration<double> busy{0};
    HostTime until = HostTime::min();
    for (const Span& span : spans) {
        if (span.end <= until) continue;
        busy += span.end - std::max(span.begin, until);
        until = span.end;
    }
    return busy.count();
}

}  // namespace natator::cuda
