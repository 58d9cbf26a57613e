#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace natator::bench {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::optional<double> convergence_order(const std::vector<double>& n, const std::vector<double>& errors) {
    double points = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
    for (std::size_t i = 0; i < n.size(); ++i) {
        if (!(errors[i] > 0) || !std::isfinite(errors[i])) continue;
        const double x = std::log(n[i]), y = std::log(errors[i]);
        points += 1;
        x_sum += x;
        y_sum += y;
        xx_sum += x * x;
        xy_sum += x * y;
    }
    const double width = points * xx_sum - x_sum * x_sum;
    if (points < 2 || !(width > 1e-12)) return std::nullopt;
    return -(points * xy_sum - x_sum * y_sum) / width;
}

std::vector<std::size_t> pareto_front(const std::vector<WorkPoint>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    double best = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (!(points[i].error < best)) continue;
        best = points[i].error;
        front.push_back(i);
    }
    return front;
}

}  // namespace natator::bench
