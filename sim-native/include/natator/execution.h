#pragma once

#include <optional>
#include <string>
#include <vector>

namespace natator {

class SettledStateCache;

/// Wall time by stage of a step, see solver/step.h. For one thread at a time.
class StageProfile {
public:
    struct Entry {
        std::string stage;
        long calls = 0;
        double seconds = 0;
    };

    void add(const char* stage, double seconds);
    /// In the order in which stages first ran.
    const std::vector<Entry>& entries() const { return entries_; }
    double seconds() const;

private:
    std::vector<Entry> entries_;
};

/// Where and how something is computed. None of these but `gpu` changes the result. What they point to must live as long as what they
/// are given to, and a profile is that of one thread.
struct Execution {
    StageProfile* profile = nullptr;     ///< where the time goes; null costs nothing
    const SettledStateCache* starts = nullptr;  ///< where settled starts are kept; null settles every time
    int threads = 1;                     ///< for scenes of many thousand particles, at most limits::threads; small ones use one all the same
    bool forces = false;                 ///< keeps what Solver::forces gives; scheme conserving only, a per cent of its time
    /// Computes on the GPU of this number (cuda_devices), in scheme `lattice` the water there and bodies on the CPU. Results agree
    /// with the CPU's to rounding. All else here, but `forces`, is the CPU's.
    std::optional<int> gpu{};
    bool skip = true;                    ///< leaves out the stages that have nothing to do, see make_unskipped_plan
};

}  // namespace natator
