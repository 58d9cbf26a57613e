#include "estimate.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace natator {
namespace {

constexpr double min_order = 0.5, max_order = 4;
constexpr double significant = 2;  // standard errors

/// Of independent errors. std::hypot would keep the program from systems older than glibc 2.35.
double of_both(double one, double other) {
    return std::sqrt(one * one + other * other);
}

/// The order that three levels show, if they show one.
std::optional<double> observed_order(const Sample& base, const Sample& half, const Sample& quarter) {
    const double first = half.mean - base.mean, second = quarter.mean - half.mean;
    if (!(std::abs(first) > significant * of_both(base.error, half.error))) return std::nullopt;
    if (!(std::abs(second) > significant * of_both(half.error, quarter.error))) return std::nullopt;
    const double order = std::log2(first / second);  // not a number where the signs differ
    if (!(order >= min_order && order <= max_order)) return std::nullopt;
    return order;
}

/// What a level's error is in a sum that has it so many times.
double weighted(double weight, const Sample& level) {
    return weight == 0 ? 0 : weight * level.error;
}

}  // namespace

Spread spread(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, values.size() > 1 ? std::sqrt(squares / (count - 1)) : 0};
}

Sample sample_of(const std::vector<double>& values) {
    if (values.empty()) return {};
    const auto [mean, deviation] = spread(values);
    const double error = values.size() > 1 ? deviation / std::sqrt(static_cast<double>(values.size()))
                                           : std::numeric_limits<double>::infinity();
    return {mean, error, static_cast<int>(values.size())};
}

Sample difference(const Sample& from, const Sample& to) {
    return {to.mean - from.mean, of_both(to.error, from.error), to.runs};
}

std::optional<Sample> relative_change(const Sample& from, const Sample& to) {
    const bool may_be_zero = std::isfinite(from.error) && std::abs(from.mean) <= significant * from.error;
    if (from.mean == 0 || may_be_zero) return std::nullopt;
    const double ratio = to.mean / from.mean;
    return Sample{ratio - 1, of_both(to.error, weighted(ratio, from)) / std::abs(from.mean), to.runs};
}

Limit limit_of(const Sample& base, const Sample& half, const std::optional<Sample>& quarter) {
    Limit limit;
    if (quarter) {
        if (const auto order = observed_order(base, half, *quarter)) {
            limit.order = *order;
            limit.observed = true;
        }
    }
    const Sample& finest = quarter ? *quarter : half;
    const Sample& before = quarter ? half : base;
    const double reach = 1 / (std::pow(2, limit.order) - 1);
    limit.from_finest = reach * (finest.mean - before.mean);
    limit.from_base = finest.mean + limit.from_finest - base.mean;
    (quarter ? limit.quarter_weight : limit.half_weight) = 1 + reach;
    (quarter ? limit.half_weight : limit.base_weight) -= reach;
    limit.base_weight -= 1;
    return limit;
}

Estimate estimate_of(const Sample& base, const std::optional<Sample>& half_time,
                     const std::optional<Sample>& quarter_time, const std::optional<Sample>& half_space,
                     bool with_step) {
    Estimate estimate;
    const bool from_half_time = with_step && half_time;
    if (half_time) estimate.time = limit_of(base, *half_time, quarter_time);
    if (half_space) estimate.space = limit_of(from_half_time ? *half_time : base, *half_space, std::nullopt);
    double base_weight = 1, half_time_weight = 0;
    estimate.value = base.mean;
    const auto add = [&](const Limit& limit) {
        estimate.value += limit.from_base;
        estimate.discretisation = of_both(estimate.discretisation, limit.from_finest);
    };
    const auto scatter = [&](double weight, const Sample& level) {
        estimate.statistical = of_both(estimate.statistical, weighted(weight, level));
    };
    if (estimate.time) {
        add(*estimate.time);
        base_weight += estimate.time->base_weight;
        half_time_weight += estimate.time->half_weight;
        if (quarter_time) scatter(estimate.time->quarter_weight, *quarter_time);
    }
    if (estimate.space) {
        add(*estimate.space);
        (from_half_time ? half_time_weight : base_weight) += estimate.space->base_weight;
        scatter(estimate.space->half_weight, *half_space);
    }
    if (half_time) scatter(half_time_weight, *half_time);
    scatter(base_weight, base);
    estimate.error = of_both(estimate.statistical, estimate.discretisation);
    return estimate;
}

}  // namespace natator
