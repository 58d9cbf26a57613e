#include "validation.h"

#include "natator/error.h"
#include "natator/evaluate.h"
#include "references.h"
#include "settled_tank.h"

namespace natator::bench {
namespace {

constexpr double tank_frames = 4 * 60;  ///< 4 s, the duration of the thesis' experiments

Row setting_fields(const Setting& setting) {
    return {to_string(setting.scheme), to_string(setting.precision), std::to_string(setting.substeps),
            std::to_string(setting.iterations)};
}

Row concatenated(Row row, const Row& more) {
    row.insert(row.end(), more.begin(), more.end());
    return row;
}

/// Fills the columns of the other part with nothing.
Row padded(Row row) {
    row.resize(validation_columns().size());
    return row;
}

std::string rate_text(double particles, const Setting& setting, double frames_per_second) {
    return measured_text(particles * setting.substeps * setting.iterations * frames_per_second / 1e6);
}

const DamBreakCase& dam_break_case(const std::string& name) {
    for (const DamBreakCase& one : dam_break_cases())
        if (one.name == name) return one;
    throw InputError("unknown dam break \"" + name + "\"");
}

void add_missing(const Row& row, std::size_t key_columns, ResultTable& table) {
    if (!table.has(Row(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(key_columns)))) table.add(row);
}

void add_front(const Row& name, const FrontCurve& front, ResultTable& fronts) {
    for (const FrontPoint& point : front)
        add_missing(concatenated(name, {measured_text(point.time), measured_text(point.position)}), front_key_columns,
                    fronts);
}

void run_column(const DamBreakCase& one, const ValidationStudy& study, const Setting& setting, ResultTable& table,
                ResultTable& fronts) {
    const Row name = concatenated({one.name, std::to_string(study.width)}, setting_fields(setting));
    const Row key = concatenated({"dam-break"}, name);
    if (table.has(key)) return;
    const DamBreakRun run = run_dam_break({one.height_over_base, study.width, one.ideal}, setting, study.last_time);
    Row row = concatenated(key, {run.instability ? "unstable" : "ok", std::to_string(run.particles)});
    if (!run.instability) {
        add_front(name, run.front, fronts);
        const FrontError error = front_error(run.front, measured_front(one.height_over_base));
        const double frames = static_cast<double>(run.front.size()) - 1;
        row = concatenated(
            row, {measured_text(run.seconds), rate_text(run.particles, setting, frames / run.seconds),
                  measured_text(run.start_height), measured_text(error.position), measured_text(error.arrival),
                  measured_text(error.lag), measured_text(error.position_after_lag)});
    }
    table.add(padded(row));
}

void run_tank(const ValidationStudy& study, const Setting& setting, ResultTable& table) {
    const Row key = concatenated({"tank", "thesis/tank", ""}, setting_fields(setting));
    if (table.has(key)) return;
    const SettledTankRun run = run_settled_tank(setting, study.rest, study.window);
    Row row = concatenated(key, {run.instability ? "unstable" : "ok", std::to_string(run.particles)});
    if (!run.instability) {
        row = concatenated(row, {measured_text(run.frame_seconds * tank_frames),
                                 rate_text(run.particles, setting, 1 / run.frame_seconds), "", "", "", "", "",
                                 measured_text(run.density_error_mean), measured_text(run.density_error_max),
                                 measured_text(run.density_deviation)});
    }
    table.add(padded(row));
}

void add_peers(ResultTable& table) {
    for (const PeerRun& peer : peer_runs())
        add_missing(
            padded({"tank", "thesis/tank", "", peer.name, "", "", "", "published", "", measured_text(peer.run_time), "",
                    "", "", "", "", "", measured_text(peer.density_error_mean), measured_text(peer.density_error_max)}),
            validation_key_columns, table);
}

}  // namespace

const std::vector<DamBreakCase>& dam_break_cases() {
    static const std::vector<DamBreakCase> cases{{"tall", 2, true}, {"square", 1, true}, {"tall-thesis", 2, false}};
    return cases;
}

Row validation_columns() {
    return fields(
        "part,case,width,scheme,precision,substeps,iterations,status,particles,run_time,"
        "particle_iterations,start_height,front_error,arrival_error,lag,front_error_after_lag,"
        "density_error_mean,density_error_max,density_deviation");
}

Row front_columns() {
    return {"case", "width", "scheme", "precision", "substeps", "iterations", "time", "position"};
}

void run_validation_study(const ValidationStudy& study, ResultTable& table, ResultTable& fronts,
                          const std::function<void(const std::string&)>& report) {
    const auto report_new = [&table, &report](auto&& run) {
        const std::size_t before = table.rows().size();
        run();
        for (std::size_t i = before; i < table.rows().size(); ++i) report(joined(table.rows()[i], " "));
    };
    for (const std::string& name : study.dam_breaks) {
        const DamBreakCase& one = dam_break_case(name);
        add_front({name, "", "experiment", "", "", ""}, measured_front(one.height_over_base), fronts);
        for (const Setting& setting : study.dam_break_settings)
            report_new([&] { run_column(one, study, setting, table, fronts); });
    }
    if (!study.tank_settings.empty()) report_new([&] { add_peers(table); });
    for (const Setting& setting : study.tank_settings) report_new([&] { run_tank(study, setting, table); });
}

}  // namespace natator::bench
