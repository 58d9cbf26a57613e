#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "natator/residuals.h"

namespace natator {

class SettledStateCache;

/// Wall time by stage of a step, see solver/step.h.
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

/// Execution options. None of them but `gpu` changes the result. What it points to must live as long as what it is given to.
struct Execution {
    StageProfile* profile = nullptr;     ///< where the time goes; null costs nothing
    const SettledStateCache* starts = nullptr;  ///< where settled starts are kept; null settles every time
    int threads = 1;                     ///< for scenes of many thousand particles, at most limits::threads; small ones use one all the same
    std::function<void(const Residuals&)> residuals{};  ///< called behind each substep with what it leaves; empty costs nothing
    bool forces = false;                 ///< keeps what Solver::forces gives; scheme conserving only, a per cent of its time
    std::optional<int> gpu{};            ///< scheme lattice: has its water on the GPU of this number (cuda_devices); other bits
    bool skip = true;                    ///< leaves out the stages that have nothing to do, see make_unskipped_plan
};

}  // namespace natator
