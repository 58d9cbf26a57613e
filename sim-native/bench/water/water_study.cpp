#include "water/water_study.h"

#include "natator/error.h"
#include "natator/evaluate.h"

namespace natator::bench {
namespace {

constexpr std::size_t max_samples = 400;  ///< of a curve that are kept

const WaterCase& water_case(const std::string& name) {
    for (const WaterCase& one : water_cases())
        if (one.name == name) return one;
    throw InputError("unknown case of water \"" + name + "\"");
}

Row with(Row row, const std::string& field) {
    row.push_back(field);
    return row;
}

Row name_of_curve(const WaterCase& one, const WaterSetting& setting) {
    const Setting& solver = setting.solver;
    return {one.name,
            std::to_string(setting.resolution),
            to_string(solver.scheme),
            to_string(solver.precision),
            setting.gpu ? "cuda" : "cpu",
            std::to_string(solver.substeps),
            std::to_string(solver.iterations),
            solver.scheme == Scheme::conserving ? yes_or_no(solver.modified_pressure) : "",
            solver.scheme == Scheme::conserving ? number_text(setting.support) : ""};
}

Row name_of(const WaterCase& one, const WaterSetting& setting) {
    return with(name_of_curve(one, setting),
                setting.solver.scheme == Scheme::conserving ? std::to_string(setting.start) : "");
}

bool is_done(const WaterCase& one, const Row& name, const ResultTable& table) {
    for (const std::string& quantity : one.quantities)
        if (!table.has(with(name, quantity))) return false;
    return true;
}

void add_curve(const Row& name, const std::vector<WaterSample>& curve, ResultTable& curves) {
    const std::size_t stride = curve.size() / max_samples + 1;
    for (std::size_t i = 0; i < curve.size(); i += stride) {
        const Row key = with(name, measured_text(curve[i].time));
        if (!curves.has(key)) curves.add(with(key, measured_text(curve[i].value)));
    }
}

void run_case(const WaterCase& one, const WaterSetting& setting, ResultTable& table, ResultTable* curves,
              const std::function<void(const std::string&)>& report) {
    if (one.held && setting.solver.scheme != Scheme::conserving) return;
    const Row name = name_of(one, setting);
    if (is_done(one, name, table)) return;
    const WaterRun run = one.run(setting);
    if (curves) add_curve(name_of_curve(one, setting), run.curve, *curves);
    for (std::size_t i = 0; i < one.quantities.size(); ++i) {
        Row row = with(name, one.quantities[i]);
        if (table.has(row)) continue;
        const bool measured = !run.instability && i < run.figures.size();
        const WaterFigure figure = measured ? run.figures[i] : WaterFigure{};
        row = with(row, measured ? "ok" : run.instability ? "unstable" : "too viscous");
        for (const double value : {figure.value, figure.reference, figure.least, figure.greatest})
            row = with(row, measured ? measured_text(value) : "");
        row = with(row, yes_or_no(measured && figure.is_met()));
        row = with(with(row, std::to_string(run.particles)), measured_text(run.seconds));
        table.add(row);
        report(joined(row, " "));
    }
}

}  // namespace

Row water_columns() {
    return fields(
        "case,resolution,scheme,precision,backend,substeps,iterations,modified_pressure,support,start,"
        "quantity,status,value,reference,least,greatest,met,particles,run_time");
}

Row water_curve_columns() {
    return fields(
        "case,resolution,scheme,precision,backend,substeps,iterations,modified_pressure,support,time,"
        "value");
}

void run_water_study(const WaterStudy& study, ResultTable& table, ResultTable& curves,
                     const std::function<void(const std::string&)>& report) {
    for (const std::string& name : study.cases) {
        if (water_case(name).held && !study.held) continue;
        for (const int resolution : study.resolutions)
            for (const Setting& setting : study.settings)
                for (const double support : study.supports)  // what has no support, and no starts, is done once
                    for (const int start : study.starts)
                        run_case(water_case(name), {setting, resolution, study.gpu, support, start}, table,
                                 start == study.starts.front() ? &curves : nullptr, report);
    }
}

}  // namespace natator::bench
