#include <array>
#include <cstdio>

#include "natator/protocol.h"

namespace natator {

using nlohmann::ordered_json;

ordered_json result_json(const nlohmann::json& id, const Evaluation& evaluation, Scheme scheme, Precision precision) {
    const bool stable = !evaluation.instability;
    ordered_json result;
    result["id"] = id;
    result["status"] = stable ? "ok" : "unstable";
    result["fitness"] = stable ? evaluation.distance : 0;
    result["distance"] = stable ? ordered_json(evaluation.distance) : ordered_json();
    result["stopped"] = to_string(evaluation.stopped);
    result["simulated"] = evaluation.simulated;
    result["frames"] = evaluation.frames;
    result["scheme"] = to_string(scheme);
    result["precision"] = to_string(precision);
    result["hash"] = hash_text(evaluation.hash);
    if (stable) {
        const LawFigures& laws = evaluation.laws;
        result["laws"] = {{"linearMomentum", laws.linear_momentum},
                          {"angularMomentum", laws.angular_momentum},
                          {"densityErrorMean", laws.density_error_mean},
                          {"densityErrorMax", laws.density_error_max}};
    } else {
        const Instability& where = *evaluation.instability;
        result["unstable"] = {{"particle", where.particle}, {"stage", where.stage}, {"time", where.time}};
    }
    return result;
}

ordered_json error_json(const nlohmann::json& id, const std::string& message) {
    return {{"id", id}, {"status", "error"}, {"error", message}};
}

const char* to_string(Scheme scheme) {
    switch (scheme) {
        case Scheme::flex:
            return "flex";
        case Scheme::conserving:
            return "conserving";
        case Scheme::dfsph:
            return "dfsph";
    }
    return "unknown";
}

const char* to_string(Precision precision) {
    return precision == Precision::double_precision ? "double" : "float";
}

const char* to_string(Stopped stopped) {
    switch (stopped) {
        case Stopped::completed:
            return "completed";
        case Stopped::touched_plane:
            return "touched-plane";
        case Stopped::no_progress:
            return "no-progress";
        case Stopped::unstable:
            break;
    }
    return "unstable";
}

std::string hash_text(std::uint64_t hash) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
    return text.data();
}

}  // namespace natator
