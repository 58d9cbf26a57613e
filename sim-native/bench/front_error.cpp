#include "front_error.h"

#include <cmath>

namespace natator::bench {
namespace {

/// y at x on the polyline through points whose x grows.
double interpolated(const FrontCurve& curve, double FrontPoint::* x, double FrontPoint::* y, double at) {
    if (at <= curve.front().*x) return curve.front().*y;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const FrontPoint &a = curve[i - 1], &b = curve[i];
        if (at > b.*x) continue;
        return std::lerp(a.*y, b.*y, b.*x > a.*x ? (at - a.*x) / (b.*x - a.*x) : 0.0);
    }
    return curve.back().*y;
}

double position_difference(const FrontCurve& computed, const FrontCurve& measured, double lag) {
    double squares = 0;
    for (const FrontPoint& point : measured)
        squares += std::pow(position_at(computed, point.time - lag) - point.position, 2);
    return std::sqrt(squares / static_cast<double>(measured.size()));
}

}  // namespace

double position_at(const FrontCurve& curve, double time) {
    return interpolated(curve, &FrontPoint::time, &FrontPoint::position, time);
}

double time_at(const FrontCurve& curve, double position) {
    return interpolated(curve, &FrontPoint::position, &FrontPoint::time, position);
}

FrontError front_error(const FrontCurve& computed, const FrontCurve& measured) {
    FrontCurve reached;
    for (const FrontPoint& point : measured)
        if (point.position <= computed.back().position && point.time <= computed.back().time) reached.push_back(point);
    if (reached.empty()) return {};
    FrontError error;
    for (const FrontPoint& point : reached) {
        const double arrival = time_at(computed, point.position);
        error.arrival += std::abs(arrival / point.time - 1) / static_cast<double>(reached.size());
        error.lag += (point.time - arrival) / static_cast<double>(reached.size());
    }
    error.position = position_difference(computed, reached, 0);
    error.position_after_lag = position_difference(computed, reached, error.lag);
    return error;
}

}  // namespace natator::bench
