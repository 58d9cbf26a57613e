#pragma once

#include <Eigen/Core>
#include <optional>

namespace natator {

/// What a swimmer is asked to do; its score is the larger the better.
struct Goal {
    enum class Measure {
        distance,  ///< way along x over ground, length
        forward,   ///< way along the own heading (Course::forward), length
        turn,      ///< heading `amount` degrees from that at the start, from +x towards +z; arrives
        depth,     ///< `amount` above the height at the start, length, below if negative; arrives
        reach,     ///< at `place` over ground, from where the body's centre was at the start; arrives
        hold,      ///< stay: 1 / (1 + d/L), d the mean distance from the start over ground, L the body's length
        economy,   ///< way along x per muscle work and body mass, s^2/length: one over the cost of transport
    };
    Measure measure = Measure::distance;
    double weight = 1;
    double amount = 0;
    Eigen::Vector3d place{0, 0, 0};
    /// How near counts as arrived: degrees for turn, else length.
    double within = 0;
    bool stop = true;  ///< arriving ends the run

    /// A goal that is arrived at. Its score is 1 - r(T)/r(0) for one that did not, r being what is left to go, and
    /// 1 + (1 - t/T) for one that came within `within` at time t of the scene's duration T.
    bool arrives() const { return measure == Measure::turn || measure == Measure::depth || measure == Measure::reach; }
};

/// Name in scenes and results: "distance", "forward", "turn", "depth", "reach", "hold", "economy".
const char* to_string(Goal::Measure measure);

/// What became of a goal.
struct GoalResult {
    Goal::Measure measure = Goal::Measure::distance;
    double weight = 1;
    double score = 0;
    std::optional<double> left;        ///< at the end, of one that is arrived at: degrees or length
    std::optional<double> arrived_at;  ///< s
};

}  // namespace natator
