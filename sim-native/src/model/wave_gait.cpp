#include "natator/gait.h"

#include <algorithm>
#include <cmath>

namespace natator {
namespace {

constexpr double beats_per_second = 2;
constexpr double waves_on_body = 0.5;
/// At the tail, of all actuators together: the fewer there are, the more each has to bend.
constexpr double sum_of_amplitudes = 4;

double to_hundredths(double value) {
    return std::round(100 * value) / 100;
}

}  // namespace

Gait wave_gait(const Creature& creature) {
    const std::vector<Actuator> actuators = creature.actuator_list();
    const std::vector<int>& ends = creature.muscle_ends();
    const auto slices = static_cast<double>(creature.slices.size());
    /// Middle of an actuator's muscles, 0 = nose, 1 = tail.
    const auto place = [&](std::size_t number) {
        if (creature.regions) return creature.regions->places[number];
        const auto gap = static_cast<std::size_t>(actuators[number].gap);
        return ((ends[gap] + ends[gap + 1]) / 2.0 + 0.5) / slices;
    };
    const auto beating = std::count_if(actuators.begin(), actuators.end(), [&](const Actuator& actuator) {
        return actuator.bend == actuators.front().bend;
    });
    Gait gait = resting_gait(static_cast<int>(actuators.size()));
    gait.frequency = beats_per_second;
    for (std::size_t i = 0; i < static_cast<std::size_t>(beating); ++i) {
        const double at = place(i);
        const double behind_first = waves_on_body * (at - place(0));
        gait.amplitude[i] = to_hundredths(std::min(1.0, sum_of_amplitudes / static_cast<double>(beating) * at));
        gait.phase[i] = to_hundredths(1 - behind_first);
        if (gait.phase[i] == 1) gait.phase[i] = 0;
    }
    return gait;
}

}  // namespace natator
