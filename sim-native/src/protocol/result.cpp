#include "protocol/protocol.h"

namespace natator {

using nlohmann::ordered_json;

namespace {

ordered_json swimming_json(const SwimmingNumbers& numbers) {
    ordered_json result;
    result["tailAmplitude"] = numbers.tail_amplitude;
    if (numbers.strouhal) result["strouhal"] = *numbers.strouhal;
    if (numbers.reynolds) result["reynolds"] = *numbers.reynolds;
    if (numbers.swimming_number) result["swimmingNumber"] = *numbers.swimming_number;
    result["across"] = numbers.across;
    if (const std::string warning = warning_of_across(numbers.across); !warning.empty()) result["warning"] = warning;
    if (numbers.cavities) result["cavities"] = *numbers.cavities;
    return result;
}

ordered_json goals_json(const std::vector<GoalResult>& goals) {
    ordered_json list = ordered_json::array();
    for (const GoalResult& goal : goals) {
        ordered_json item = {{"measure", to_string(goal.measure)}, {"weight", goal.weight}, {"score", goal.score}};
        if (goal.left) item["left"] = *goal.left;
        if (goal.arrived_at) item["arrivedAt"] = *goal.arrived_at;
        list.push_back(std::move(item));
    }
    return list;
}

ordered_json course_json(const Course& course) {
    return {{"forward", course.forward}, {"yaw", course.yaw}, {"roll", course.roll}};
}

ordered_json companions_json(const std::vector<CompanionResult>& companions) {
    ordered_json list = ordered_json::array();
    for (const CompanionResult& one : companions)
        list.push_back({{"creature", one.creature}, {"distance", one.distance}, {"course", course_json(one.course)}});
    return list;
}

ordered_json renewal_json(const WaterRenewal& renewal) {
    const Eigen::Vector3d& momentum = renewal.momentum;
    return {{"times", renewal.times},
            {"particles", renewal.particles},
            {"momentum", {momentum.x(), momentum.y(), momentum.z()}},
            {"kineticEnergy", renewal.kinetic_energy}};
}

}  // namespace

ordered_json result_json(const nlohmann::json& id, const Evaluation& evaluation, Scheme scheme, Precision precision) {
    const bool stable = !evaluation.instability;
    ordered_json result;
    result["id"] = id;
    result["status"] = stable ? "ok" : "unstable";
    result["fitness"] = evaluation.fitness();
    result["distance"] = stable ? ordered_json(evaluation.distance) : ordered_json();
    result["stopped"] = to_string(evaluation.stopped);
    result["simulated"] = evaluation.simulated;
    result["frames"] = evaluation.frames;
    result["scheme"] = to_string(scheme);
    result["precision"] = to_string(precision);
    result["hash"] = hash_text(evaluation.hash);
    if (evaluation.cells_per_step > 0) result["cellsPerSubstep"] = evaluation.cells_per_step;
    if (stable) {
        const ConservationErrors& laws = evaluation.errors;
        result["laws"] = {{"linearMomentum", laws.linear_momentum},
                          {"angularMomentum", laws.angular_momentum},
                          {"densityErrorMean", laws.density_error_mean},
                          {"densityErrorMax", laws.density_error_max}};
        if (evaluation.swimming) result["swimming"] = swimming_json(*evaluation.swimming);
        if (evaluation.work) result["work"] = *evaluation.work;
        if (evaluation.smagorinsky > 0) result["smagorinsky"] = evaluation.smagorinsky;
        if (const auto& course = evaluation.course) result["course"] = course_json(*course);
        if (!evaluation.goals.empty()) result["goals"] = goals_json(evaluation.goals);
        if (!evaluation.companions.empty()) result["companions"] = companions_json(evaluation.companions);
        if (evaluation.renewal) result["renewal"] = renewal_json(*evaluation.renewal);
    } else {
        const Instability& where = *evaluation.instability;
        result["unstable"] = {
            {"particle", where.particle}, {"stage", where.stage}, {"time", where.time}, {"law", where.law}};
    }
    return result;
}

ordered_json error_json(const nlohmann::json& id, const std::string& message) {
    return {{"id", id}, {"status", "error"}, {"error", message}};
}

}  // namespace natator
