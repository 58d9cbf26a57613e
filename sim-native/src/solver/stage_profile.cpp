#include <algorithm>
#include <numeric>

#include "natator/solver.h"

namespace natator {

void StageProfile::add(const char* stage, double seconds) {
    auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) { return one.stage == stage; });
    if (entry == entries_.end()) entry = entries_.insert(entries_.end(), Entry{stage});
    entry->calls += 1;
    entry->seconds += seconds;
}

double StageProfile::seconds() const {
    return std::accumulate(entries_.begin(), entries_.end(), 0.0,
                           [](double sum, const Entry& entry) { return sum + entry.seconds; });
}

}  // namespace natator
