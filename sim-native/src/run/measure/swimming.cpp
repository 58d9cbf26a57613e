#include "natator/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "natator/solver.h"

namespace natator {
namespace {

constexpr int max_periods = 3;
constexpr double min_steps = 8;  // of a period, to see its peaks

/// `path` at `at` steps from its start, linear between its values.
double value_at(const std::vector<double>& path, double at) {
    const auto before = std::min(static_cast<std::size_t>(std::max(at, 0.0)), path.size() - 1);
    const std::size_t after = std::min(before + 1, path.size() - 1);
    return std::lerp(path[before], path[after], at - static_cast<double>(before));
}

/// Range of the path between two places in steps, less the line between them.
double range_between(const std::vector<double>& path, double begin, double end) {
    const double first = value_at(path, begin), last = value_at(path, end);
    double low = 0, high = 0;  // both ends
    for (double at = std::ceil(begin); at <= std::floor(end); ++at) {
        const double left = value_at(path, at) - std::lerp(first, last, (at - begin) / (end - begin));
        low = std::min(low, left);
        high = std::max(high, left);
    }
    return high - low;
}

/// How many of the last periods, `steps` long each, are looked at on a path.
int last_periods(const std::vector<double>& path, double steps) {
    constexpr double rounding = 1e-9;
    const double all = static_cast<double>(path.size()) - 1;
    return std::min(max_periods, static_cast<int>(std::min(all / steps + rounding, 1e6)));
}

}  // namespace

double water_across(const Model& model) {
    const bool water = model.water_box || std::any_of(model.phase.begin(), model.phase.end(),
                                                      [](std::uint32_t bits) { return (bits & phase::fluid) != 0; });
    if (!water) return 0;
    const bool plane = model.water_box && model.water_box->is_plane();
    double across = 0;
    for (const std::vector<int>& slice : model.body.slices) {
        Eigen::Array3d low = model.position[slice.front()], high = low;
        for (const int particle : slice) {
            low = low.min(model.position[particle].array());
            high = high.max(model.position[particle].array());
        }
        const Eigen::Array3d size = high - low + model.body.spacing;
        across = std::max(across, plane ? size.z() : std::min(size.y(), size.z()));
    }
    return across / (model.water_box ? model.water_box->cell : model.parameters.fluid_rest_distance);
}

std::string warning_of_across(double across) {
    if (across == 0 || across > min_spacings_across - 0.01) return "";
    return "the body is " + figure_text(across) + " spacings of the water across: at least " +
           figure_text(min_spacings_across) +
           " are needed, below which its speed may change by half with a finer water";
}

template <class Real>
double tail_z(const Body& body, const State<Real>& state) {
    if (body.slices.empty()) return 0;
    double sum = 0;
    for (const int particle : body.slices.back()) sum += static_cast<double>(state.position[particle].z());
    return sum / static_cast<double>(body.slices.back().size());
}

std::optional<double> peak_to_peak(const std::vector<double>& path, double time_step, double period) {
    const double steps = period / time_step, all = static_cast<double>(path.size()) - 1;
    const int periods = last_periods(path, steps);
    if (periods < 1 || steps < min_steps) return std::nullopt;
    double sum = 0;
    for (int k = 0; k < periods; ++k) sum += range_between(path, std::max(all - (k + 1) * steps, 0.0), all - k * steps);
    return sum / periods;
}

std::optional<SwimmingNumbers> swimming_numbers(const Model& model, const Gait& gait, double distance, double simulated,
                                                const std::vector<double>& tail, const std::vector<double>& path) {
    if (model.actuators == 0 || !(make_plan(model).water || model.water_box)) return std::nullopt;
    const std::optional<double> amplitude = peak_to_peak(tail, model.time_step, 1 / gait.frequency);
    if (!amplitude) return std::nullopt;
    SwimmingNumbers numbers;
    numbers.tail_amplitude = *amplitude;
    numbers.across = water_across(model);
    const double speed = std::abs(distance) / simulated, length = model.body.length;
    const double viscosity = model.parameters.conserving.kinematic_viscosity;
    const double steps = 1 / gait.frequency / model.time_step, beats = last_periods(path, steps) * steps;
    const double end = static_cast<double>(path.size()) - 1;
    const double last = std::abs(path.back() - value_at(path, end - beats)) / (beats * model.time_step);
    if (last > 0) numbers.strouhal = gait.frequency * *amplitude / last;
    if (viscosity > 0) {
        numbers.reynolds = speed * length / viscosity;
        numbers.swimming_number = 2 * std::numbers::pi * gait.frequency * *amplitude * length / viscosity;
    }
    return numbers;
}

template double tail_z(const Body&, const State<float>&);
template double tail_z(const Body&, const State<double>&);

}  // namespace natator
