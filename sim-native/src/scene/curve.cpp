#include "curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"

namespace natator::fields {
namespace {

constexpr std::size_t max_points = 1000;

/// Slope at a point between two stretches of the lengths h0 and h1 and the mean slopes d0 and d1.
double slope_between(double h0, double h1, double d0, double d1) {
    if (!(d0 * d1 > 0)) return 0;
    const double w0 = h0 + 2 * h1, w1 = 2 * h0 + h1;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// Slope at an end of the curve, beside the stretch 0, behind which is stretch 1.
double slope_at_end(double h0, double h1, double d0, double d1) {
    const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if (!(slope * d0 > 0)) return 0;
    return d0 * d1 < 0 && std::abs(slope) > 3 * std::abs(d0) ? 3 * d0 : slope;
}

Curve::Point read_point(const json& value, const Place& place, const Range& range) {
    if (!value.is_array() || value.size() != 2) refuse(place, value, "a point [part of the length, value]");
    Curve::Point point{};
    read(value[0], place.item(0), {0, 1, false, "part of the length"}, point.at);
    read(value[1], place.item(1), range, point.value);
    return point;
}

}  // namespace

Curve::Curve(std::vector<Point> points) : points_(std::move(points)), slopes_(points_.size()) {
    const std::size_t last = points_.size() - 1;
    std::vector<double> length(last), slope(last);
    for (std::size_t i = 0; i < last; ++i) {
        length[i] = points_[i + 1].at - points_[i].at;
        slope[i] = (points_[i + 1].value - points_[i].value) / length[i];
    }
    if (last == 1) slopes_ = {slope[0], slope[0]};
    if (last < 2) return;
    slopes_[0] = slope_at_end(length[0], length[1], slope[0], slope[1]);
    for (std::size_t i = 1; i < last; ++i) slopes_[i] = slope_between(length[i - 1], length[i], slope[i - 1], slope[i]);
    slopes_[last] = slope_at_end(length[last - 1], length[last - 2], slope[last - 1], slope[last - 2]);
}

double Curve::at(double place) const {
    if (!(place > points_.front().at)) return points_.front().value;
    if (!(place < points_.back().at)) return points_.back().value;
    const auto behind = std::upper_bound(points_.begin(), points_.end(), place,
                                         [](double x, const Point& point) { return x < point.at; });
    const auto i = static_cast<std::size_t>(behind - points_.begin()) - 1;
    const Point &a = points_[i], &b = points_[i + 1];
    const double h = b.at - a.at, t = (place - a.at) / h;
    const double value = (1 + 2 * t) * (1 - t) * (1 - t) * a.value + t * t * (3 - 2 * t) * b.value +
                         h * t * (1 - t) * ((1 - t) * slopes_[i] - t * slopes_[i + 1]);
    return std::clamp(value, std::min(a.value, b.value), std::max(a.value, b.value));  // against rounding
}

Curve read_curve(const json& value, const Place& place, const Range& range, double begin, double end) {
    if (value.is_number()) {
        double constant = 0;
        read(value, place, range, constant);
        return Curve({{0, constant}});
    }
    if (!value.is_array() || value.size() < 2 || value.size() > max_points)
        refuse(place, value, "a number, or a curve of 2 to 1000 points [part of the length, value]");
    std::vector<Curve::Point> points;
    for (std::size_t i = 0; i < value.size(); ++i) {
        points.push_back(read_point(value[i], place.item(i), range));
        if (i > 0 && !(points[i].at > points[i - 1].at))
            refuse(place.item(i).item(0), value[i][0],
                   "more than " + value[i - 1][0].dump() + ", where the point before is: curves ascend along the body");
    }
    const std::string first = number_text(begin), last = number_text(end);
    const std::string covers = " of the length, so that the curve covers " + first + " to " + last;
    if (points.front().at > begin) refuse(place.item(0).item(0), value.front()[0], "at " + first + covers);
    if (points.back().at < end)
        refuse(place.item(value.size() - 1).item(0), value.back()[0], (end < 1 ? "at least " : "at ") + last + covers);
    return Curve(std::move(points));
}

}  // namespace natator::fields
