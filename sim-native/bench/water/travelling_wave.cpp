#include <algorithm>
#include <cmath>

#include "water/swim.h"

namespace natator::bench {
namespace {

/// 32 particles long at resolution 20.
constexpr double length = 1.6 * water_length;
constexpr double frequency = 0.5;  ///< 1/s
constexpr int counted = 2;         ///< beats at the end of a leg

/// A part of the way.
struct Leg {
    double viscosity;  ///< length^2/s
    int beats;
};
constexpr Leg legs[] = {{0.003, 7}, {0.006, 4}, {0.01, 4}};
constexpr double max_drift = 0.2;  ///< to the side, of the length: nearer to a wall it swims in other water

constexpr double slow_reynolds = 60, slow_strouhal = 2.5, fast_reynolds = 1400, fast_strouhal = 0.72;
const double fall = std::log(slow_strouhal / fast_strouhal) / std::log(fast_reynolds / slow_reynolds);

/// False if the water becomes unstable, or is too viscous.
template <class Real>
bool swim(const Leg& leg, Swim<Real>& swim, std::vector<WaterFigure>& figures, std::vector<WaterSample>& curve) {
    if (!swim.set_kinematic_viscosity(leg.viscosity)) return false;
    const SwimBody& body = swim.body();
    Track track;
    const long first = (leg.beats - counted) * body.frames_per_beat();
    double begin = 0;
    for (long k = 1; k <= leg.beats * body.frames_per_beat(); ++k) {
        if (!swim.frame()) return false;
        if (k == first) begin = body.time();
        if (k >= first) {
            track.centre.push_back(body.centre());
            track.tail.push_back(body.tail());
        }
        curve.push_back({body.time(), body.velocity().x() / length});
    }
    const Eigen::Vector3d velocity = (track.centre.back() - track.centre.front()) / (body.time() - begin);
    const double speed = velocity.norm(), beat = track.beat(Eigen::Vector3d::UnitY().cross(velocity.normalized()));
    const double reynolds = speed * length / leg.viscosity, beating = frequency * beat;
    figures.push_back(figure_within(0.25, beating / speed, strouhal_of_larvae(reynolds)));
    figures.push_back({.value = reynolds, .reference = reynolds_of_larvae(beating * length / leg.viscosity)});
    figures.push_back({.value = beat / length, .reference = 0.5});
    return true;
}

}  // namespace

double strouhal_of_larvae(double reynolds) {
    return slow_strouhal * std::pow(reynolds / slow_reynolds, -fall);
}

double reynolds_of_larvae(double beating) {
    return slow_reynolds * std::pow(beating / (slow_reynolds * slow_strouhal), 1 / (1 - fall));
}

/// A larva that beats its tail and swims as far as the water pushes it, ever more viscous.
WaterRun run_travelling_wave(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) {
        Swim<decltype(real)> larva(read_swim_case("larva").base, {.length = length, .beat = 1 / frequency}, setting);
        std::vector<WaterFigure> figures;
        std::vector<WaterSample> curve;
        if (std::ranges::all_of(legs, [&](const Leg& leg) { return swim(leg, larva, figures, curve); }))
            figures.push_back({.value = larva.body().drift(), .reference = 0, .greatest = max_drift});
        WaterRun run = larva.run();
        run.figures = figures;
        run.curve = curve;
        return run;
    });
}

}  // namespace natator::bench
