#include <map>

#include "natator/error.h"
#include "natator/evaluate.h"
#include "stability.h"

namespace natator::bench {
namespace {

constexpr double quick_share = 0.2;  ///< of the scene's duration

Row key_of(Scheme scheme, Precision precision, bool gpu, const StabilityScene& scene, const StabilityPoint& point) {
    const bool two = !point.second_axis.empty();
    return {
        to_string(scheme), to_string(precision),     gpu ? "cuda" : "cpu", scene.name,
        point.axis,        number_text(point.value), point.second_axis,    two ? number_text(point.second_value) : ""};
}

Row row_of(Row key, const StabilityResult& result) {
    const std::optional<Instability>& bad = result.instability;
    const LawMargins& margins = result.margins;
    Row row = joined_rows(std::move(key), bad ? Row{"unstable", bad->law, std::to_string(bad->particle), bad->stage}
                                              : Row{"ok", "", "", ""});
    for (const double figure : {bad ? bad->time : result.time, margins.particle_energy, margins.energy, margins.depth,
                                margins.reach, margins.compression, margins.largest()})
        row.push_back(measured_text(figure));
    return row;
}

StabilityCase case_at(const StabilityScene& scene, const StabilityPoint& point, Scheme scheme,
                      const StabilityStudy& study) {
    StabilityCase subject = calm_case(scene);
    subject.scene.scheme = scheme;
    subject.scene.duration = study.duration * (study.quick ? quick_share : 1);
    stability_axis(point.axis).set(subject, point.value);
    if (!point.second_axis.empty()) stability_axis(point.second_axis).set(subject, point.second_value);
    return subject;
}

/// "float cpu small-tank dt 32 iterations 16"; the second axis may be absent.
std::string place_text(const Row& place) {
    const auto used = place[5].empty() ? place.begin() + 5 : place.end();
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
    return fields(
        "scheme,precision,backend,scene,axis,value,second_axis,second_value,status,law,particle,stage,"
        "time,particle_energy,energy,depth,reach,compression,largest");
}

void run_stability_study(const StabilityStudy& study, ResultTable& table,
                         const std::function<void(const std::string&)>& report) {
    const auto run = [&](const StabilityScene& scene, const StabilityPoint& point, Precision precision, Scheme scheme) {
        const Row key = key_of(scheme, precision, study.gpu.has_value(), scene, point);
        if (table.has(key)) return;
        try {
            table.add(row_of(key, run_stability(case_at(scene, point, scheme, study), precision, study.gpu)));
            report(joined(table.rows().back(), " "));
        } catch (const InputError& error) {
            report("left out: " + joined(key, " ") + ": " + error.what());
        }
    };
    for (const std::string& name : study.scenes) {
        const StabilityScene& scene = stability_scene(name);
        for (const StabilityPoint& point : stability_points(study.axes, study.quick))
            for (const Precision precision : study.precisions)
                for (const Scheme scheme : study.schemes)
                    if (scheme == Scheme::conserving || !scene.conserving_only) run(scene, point, precision, scheme);
    }
}

std::vector<std::string> where_only_flex_is_ok(const std::vector<Row>& rows) {
    constexpr std::size_t status = stability_key_columns, law = status + 1;
    const auto place_of = [](const Row& row) { return Row(row.begin() + 1, row.begin() + stability_key_columns); };
    std::map<Row, const Row*> conserving;
    for (const Row& row : rows)
        if (row[0] == to_string(Scheme::conserving)) conserving[place_of(row)] = &row;
    std::vector<std::string> places;
    for (const Row& row : rows) {
        const auto other = conserving.find(place_of(row));
        if (row[0] != to_string(Scheme::flex) || row[status] != "ok" || other == conserving.end()) continue;
        if ((*other->second)[status] != "ok") places.push_back(place_text(other->first) + ": " + (*other->second)[law]);
    }
    return places;
}

}  // namespace natator::bench
