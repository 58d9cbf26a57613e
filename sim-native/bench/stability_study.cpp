#include <map>

#include "natator/evaluate.h"
#include "stability.h"

namespace natator::bench {
namespace {

constexpr double quick_share = 0.2;  ///< of the scene's duration

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::ok:
            return "ok";
        case Verdict::diverged:
            return "diverged";
        case Verdict::unstable:
            break;
    }
    return "unstable";
}

Row key_of(Scheme scheme, Precision precision, const StabilityPoint& point) {
    const bool two = !point.second_axis.empty();
    return {to_string(scheme),        to_string(precision), point.axis,
            number_text(point.value), point.second_axis,    two ? number_text(point.second_value) : ""};
}

Row row_of(Row key, const StabilityResult& result) {
    for (const std::string& field :
         {std::string(name_of(result.verdict)), result.particle < 0 ? "" : std::to_string(result.particle),
          result.stage, measured_text(result.time), measured_text(result.max_speed),
          measured_text(result.max_kinetic_energy), std::to_string(result.outside), measured_text(result.compression)})
        key.push_back(field);
    return key;
}

StabilityCase case_at(const StabilityPoint& point, Scheme scheme, const StabilityStudy& study) {
    StabilityCase subject = calm_case();
    subject.scene.scheme = scheme;
    subject.scene.solver.modifiedPressure = study.modified_pressure;
    if (study.quick) subject.scene.duration *= quick_share;
    stability_axis(point.axis).set(subject, point.value);
    if (!point.second_axis.empty()) stability_axis(point.second_axis).set(subject, point.second_value);
    return subject;
}

/// "float dt 32 iterations 16"; the second axis may be absent.
std::string place_text(const Row& place) {
    const auto used = place[3].empty() ? place.begin() + 3 : place.end();
    return joined(Row(place.begin(), used), " ");
}

void add_axis(const StabilityAxis& axis, bool quick, std::vector<StabilityPoint>& points) {
    for (const double value : quick ? axis.quick_values : axis.values)
        points.push_back({.axis = axis.name, .value = value, .second_axis = "", .second_value = 0});
}

/// In a quick study the corners of the map.
void add_map(const StabilityMap& map, bool quick, std::vector<StabilityPoint>& points) {
    const auto picked = [quick](const std::vector<double>& values) {
        return quick ? std::vector{values.front(), values.back()} : values;
    };
    for (const double value : picked(map.first_values))
        for (const double second : picked(map.second_values)) points.push_back({map.first, value, map.second, second});
}

}  // namespace

std::vector<StabilityPoint> stability_points(const std::vector<std::string>& names, bool quick) {
    std::vector<StabilityPoint> points;
    if (names.empty()) {
        for (const StabilityAxis& axis : stability_axes()) add_axis(axis, quick, points);
        for (const StabilityMap& map : stability_maps()) add_map(map, quick, points);
    }
    for (const std::string& name : names) {
        bool is_map = false;
        for (const StabilityMap& map : stability_maps()) {
            if (name != map.first + ":" + map.second) continue;
            add_map(map, quick, points);
            is_map = true;
        }
        if (!is_map) add_axis(stability_axis(name), quick, points);
    }
    return points;
}

Row stability_columns() {
    return {"scheme",   "precision", "axis", "value",     "second_axis",        "second_value", "status",
            "particle", "stage",     "time", "max_speed", "max_kinetic_energy", "outside",      "compression"};
}

void run_stability_study(const StabilityStudy& study, ResultTable& table,
                         const std::function<void(const std::string&)>& report) {
    for (const StabilityPoint& point : stability_points(study.axes, study.quick)) {
        for (const Precision precision : study.precisions) {
            for (const Scheme scheme : study.schemes) {
                const Row key = key_of(scheme, precision, point);
                if (table.has(key)) continue;
                table.add(row_of(key, run_stability(case_at(point, scheme, study), precision)));
                report(joined(table.rows().back(), " "));
            }
        }
    }
}

std::vector<std::string> where_only_flex_is_ok(const std::vector<Row>& rows) {
    std::map<Row, std::string> conserving;
    for (const Row& row : rows)
        if (row[0] == to_string(Scheme::conserving)) conserving[Row(row.begin() + 1, row.begin() + 6)] = row[6];
    std::vector<std::string> places;
    for (const Row& row : rows) {
        const Row place(row.begin() + 1, row.begin() + 6);
        const auto other = conserving.find(place);
        if (row[0] != to_string(Scheme::flex) || row[6] != "ok" || other == conserving.end()) continue;
        if (other->second != "ok") places.push_back(place_text(place) + ": " + other->second);
    }
    return places;
}

}  // namespace natator::bench
