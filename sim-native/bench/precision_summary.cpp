#include <charconv>
#include <map>

#include "natator/evaluate.h"
#include "precision.h"
#include "statistics.h"

namespace natator::bench {
namespace {

/// Columns of precision_columns().
enum Column { scene, scheme, precision, substeps, iterations, status, repeats, run_time, error_early, error_late };

constexpr double min_substeps = 4;  ///< in a fit: fewer are far from the limit

double value_of(const Row& row, Column column) {
    double value = 0;
    std::from_chars(row[column].data(), row[column].data() + row[column].size(), value);
    return value;
}

std::string order_text(const std::vector<Row>& rows, Column error) {
    std::vector<double> n, errors;
    for (const Row& row : rows) {
        n.push_back(value_of(row, substeps));
        errors.push_back(value_of(row, error));
    }
    const auto order = convergence_order(n, errors);
    return order ? measured_text(*order) : "";
}

}  // namespace

ResultTable convergence_orders(const std::vector<Row>& rows) {
    std::map<Row, std::vector<Row>> groups;
    for (const Row& row : rows) {
        const bool fits = row[status] == "ok" && value_of(row, substeps) >= min_substeps;
        if (fits && row[precision] == to_string(Precision::double_precision))
            groups[{row[scene], row[scheme], row[iterations]}].push_back(row);
    }
    ResultTable orders("", {"scene", "scheme", "iterations", "points", "order_0.1", "order_0.25"}, 3);
    for (const auto& [key, group] : groups)
        orders.add({key[0], key[1], key[2], std::to_string(group.size()), order_text(group, error_early),
                    order_text(group, error_late)});
    return orders;
}

std::string pareto_text(const std::vector<Row>& rows) {
    std::map<Row, std::vector<Row>> groups;
    for (const Row& row : rows)
        if (row[status] == "ok") groups[{row[scene], row[scheme]}].push_back(row);
    std::string text;
    for (const auto& [key, group] : groups) {
        std::vector<WorkPoint> points;
        for (const Row& row : group) points.push_back({value_of(row, run_time), value_of(row, error_late)});
        for (const std::size_t i : pareto_front(points)) {
            const Row& row = group[i];
            text += key[0] + " " + key[1] + " " + row[precision] + " " + row[substeps] + " x " + row[iterations] +
                    ": " + row[run_time] + " s, error " + row[error_late] + "\n";
        }
    }
    return text;
}

}  // namespace natator::bench
