#pragma once

#include <vector>

#include "base/field.h"

namespace natator::fields {

/// A smooth curve through points: cubic between neighbours, with slopes that keep it monotone wherever the points are
/// (Fritsch and Butland 1984; what SciPy calls PCHIP). So it never goes beyond the values of the two points around.
/// Of two points it is a straight line, of one a constant.
class Curve {
public:
    struct Point {
        double at, value;
    };

    /// @param points one or more, ascending in `at`
    explicit Curve(std::vector<Point> points);

    /// Value at a place; before the first and behind the last point theirs.
    double at(double place) const;

    double first() const { return points_.front().at; }

private:
    std::vector<Point> points_;
    std::vector<double> slopes_;  ///< at each point
};

/// Reads a curve from an array of points [part of the length, value], ascending in the first, with values in `range`;
/// or a constant from a number. The points must cover the parts from `begin` to `end`. Throws InputError.
Curve read_curve(const json& value, const Place& place, const Range& range, double begin = 0, double end = 1);

}  // namespace natator::fields
