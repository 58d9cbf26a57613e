#include "ensemble.h"

#include <charconv>
#include <map>

#include "natator/evaluate.h"
#include "run/converge/estimate.h"
#include "scene/scene_json.h"

namespace natator::bench {
namespace {

Scene scene_for(int creature, const Setting& setting, double duration) {
    Scene scene = load_scene("thesis/creature-" + std::to_string(creature));
    scene.scheme = setting.scheme;
    set_steps(steps_of(setting), scene.solver);
    scene.duration = duration;
    scene.stopping = {.plane_contact = false, .no_progress_after = 0};
    return scene;
}

Row key_of(int creature, const Setting& setting, int seed) {
    return {std::to_string(creature),         to_string(setting.scheme),          to_string(setting.precision),
            std::to_string(setting.substeps), std::to_string(setting.iterations), std::to_string(seed)};
}

}  // namespace

Row ensemble_columns() {
    return {"creature", "scheme", "precision", "substeps", "iterations", "seed", "status", "distance", "hash"};
}

void run_ensemble_study(const EnsembleStudy& study, ResultTable& table,
                        const std::function<void(const std::string&)>& report) {
    for (int seed = 1; seed <= study.runs; ++seed) {
        for (const int creature : study.creatures) {
            for (const Setting& setting : study.settings) {
                Row row = key_of(creature, setting, seed);
                if (table.has(row)) continue;
                const EvaluationOptions options{.precision = setting.precision,
                                                .perturbation = {study.perturbation, static_cast<std::uint64_t>(seed)}};
                const Evaluation result =
                    evaluate(scene_for(creature, setting, study.duration), thesis_gait(creature), options);
                const bool stable = !result.instability;
                row.insert(row.end(), {stable ? "ok" : "unstable", stable ? number_text(result.distance) : "",
                                       hash_text(result.hash)});
                table.add(row);
                report(joined(row, " "));
            }
        }
    }
}

ResultTable ensemble_summary(const std::vector<Row>& rows) {
    constexpr std::size_t seed = 5, status = 6, distance = 7;
    std::map<Row, std::vector<double>> ensembles;
    for (const Row& row : rows) {
        if (row[status] != "ok") continue;
        double value = 0;
        std::from_chars(row[distance].data(), row[distance].data() + row[distance].size(), value);
        ensembles[Row(row.begin(), row.begin() + seed)].push_back(value);
    }
    ResultTable summary("", {"creature", "scheme", "precision", "substeps", "iterations", "runs", "mean", "deviation"},
                        seed);
    for (const auto& [key, distances] : ensembles) {
        const Spread figures = spread(distances);
        Row row = key;
        row.insert(row.end(),
                   {std::to_string(distances.size()), measured_text(figures.mean), measured_text(figures.deviation)});
        summary.add(row);
    }
    return summary;
}

}  // namespace natator::bench
