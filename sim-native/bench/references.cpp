#include "references.h"

#include <nlohmann/json.hpp>

#include "natator/error.h"
#include "scene/data_files.h"

namespace natator::bench {

FrontCurve measured_front(int height_over_base) {
    const nlohmann::json experiment = read_data_file("references", "martin-moyce-1952");
    for (const auto& column : experiment.at("columns")) {
        if (column.at("heightOverBase") != height_over_base) continue;
        FrontCurve curve;
        for (const auto& point : column.at("front")) curve.push_back({point.at(0), point.at(1)});
        return curve;
    }
    throw InputError("no measured column of height over base " + std::to_string(height_over_base));
}

std::vector<PeerRun> peer_runs() {
    const nlohmann::json document = read_data_file("references", "thesis-tank-peers");
    std::vector<PeerRun> runs;
    for (const auto& run : document.at("runs"))
        runs.push_back({run.at("name"), run.at("runTime"), run.at("densityErrorMean"), run.at("densityErrorMax")});
    return runs;
}

}  // namespace natator::bench
