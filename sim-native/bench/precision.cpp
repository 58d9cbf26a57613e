#include "precision.h"

#include "natator/evaluate.h"
#include "statistics.h"

namespace natator::bench {
namespace {

Row key_of(const std::string& scene, const Setting& setting) {
    return {scene, to_string(setting.scheme), to_string(setting.precision), std::to_string(setting.substeps),
            std::to_string(setting.iterations)};
}

Row row_of(Row row, const Subject& subject, const PathRun& run, const PathRun& reference,
           const std::vector<double>& seconds) {
    row.insert(row.end(),
               {run.instability ? "unstable" : "ok", std::to_string(seconds.size()), measured_text(median(seconds))});
    if (run.instability) {
        row.resize(precision_columns().size());
        return row;
    }
    for (std::size_t mark = 0; mark < path_times.size(); ++mark)
        row.push_back(measured_text(path_error(run.places[mark], reference.places[mark])));
    row.push_back(measured_text(run.density_error_mean));
    row.push_back(measured_text(run.density_error_max));
    row.push_back(subject.isolated ? measured_text(run.linear_momentum_error) : "");
    row.push_back(subject.isolated ? measured_text(run.angular_momentum_error) : "");
    row.push_back(measured_text(run.energy_change));
    row.push_back(measured_text(run.spring_residual));
    row.push_back(measured_text(run.cluster_residual));
    row.push_back(hash_text(run.hash));
    return row;
}

std::vector<Setting> missing_settings(const PrecisionStudy& study, const std::string& scene, Scheme scheme,
                                      Precision precision, const ResultTable& table) {
    std::vector<Setting> settings;
    for (const int substeps : study.substeps) {
        for (const int iterations : study.iterations) {
            const Setting setting{scheme, precision, substeps, iterations};
            if (!table.has(key_of(scene, setting))) settings.push_back(setting);
        }
    }
    return settings;
}

}  // namespace

Setting reference_setting(Scheme scheme) {
    return {scheme, Precision::double_precision, 1024, 4};
}

Row precision_columns() {
    return fields(
        "scene,scheme,precision,substeps,iterations,status,repeats,run_time,path_error_0.1,"
        "path_error_0.25,density_error_mean,density_error_max,linear_momentum_error,"
        "angular_momentum_error,energy_change,spring_residual,cluster_residual,hash");
}

void run_precision_study(const PrecisionStudy& study, ResultTable& table,
                         const std::function<void(const std::string&)>& report) {
    for (const std::string& scene : study.scenes) {
        const Subject subject = make_subject(scene);
        for (const Scheme scheme : study.schemes) {
            std::optional<PathRun> reference;
            const State<double> start = settled_start(subject, scheme);
            for (const Precision precision : study.precisions) {
                const std::vector<Setting> settings = missing_settings(study, scene, scheme, precision, table);
                if (settings.empty()) continue;
                if (!reference) reference = run_path(subject, reference_setting(scheme), start);
                if (reference->instability) throw std::runtime_error(scene + ": the reference is unstable");

                std::vector<PathRun> runs(settings.size());
                std::vector<std::vector<double>> seconds(settings.size());
                for (int repeat = 0; repeat < study.repeats; ++repeat) {
                    for (std::size_t i = 0; i < settings.size(); ++i) {
                        runs[i] = run_path(subject, settings[i], start);
                        seconds[i].push_back(runs[i].seconds);
                    }
                }
                for (std::size_t i = 0; i < settings.size(); ++i) {
                    table.add(row_of(key_of(scene, settings[i]), subject, runs[i], *reference, seconds[i]));
                    report(joined(table.rows().back(), " "));
                }
            }
        }
    }
}

}  // namespace natator::bench
