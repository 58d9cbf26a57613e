#pragma once

#include <cstddef>
#include <optional>
#include <vector>

/// The few figures that studies draw from their samples.
namespace natator::bench {

/// Mean of the two middle values if there is an even number. Needs at least one value.
double median(std::vector<double> values);

/// Order p of error = c n^-p by least squares of log(error) over log(n). Points with an error that is not positive and
/// finite are left out; nothing if fewer than two different n remain.
std::optional<double> convergence_order(const std::vector<double>& n, const std::vector<double>& errors);

/// A point of a work-precision diagram.
struct WorkPoint {
    double cost = 0;
    double error = 0;
};

/// Indices of the points that no other point beats in one value without losing in the other, cheapest first. Of equal
/// points the first counts.
std::vector<std::size_t> pareto_front(const std::vector<WorkPoint>& points);

}  // namespace natator::bench
