#include "convergence_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "scene/scene_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

// Numbers that are not finite become null.
ordered_json sample_json(const Sample& sample) {
    return {{"mean", sample.mean}, {"error", sample.error}};
}

ordered_json limit_json(const Limit& limit) {
    return {{"order", limit.order}, {"observed", limit.observed}, {"change", limit.from_base}};
}

/// With as many digits as the error has meaning for: two of it.
std::string with_error(double value, double error) {
    std::ostringstream text;
    const bool known = std::isfinite(error);
    const int digits = known && error > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9) : 4;
    text << std::fixed << std::setprecision(digits) << value << " +- ";
    if (known)
        text << error;
    else
        text << '?';
    return text.str();
}

/// In per cent of the first speed, as a speed where that may be 0; nothing where there is none.
std::string change_text(const Sample& from, const Sample& to) {
    if (from.runs == 0) return "";
    if (const auto relative = relative_change(from, to))
        return with_error(100 * relative->mean, 100 * relative->error) + " %";
    const Sample by = difference(from, to);
    return with_error(by.mean, by.error) + " length/s";
}

std::string scatter_text(const Estimate& estimate) {
    if (!std::isfinite(estimate.statistical)) return "not known from one run";
    std::ostringstream text;
    text << std::setprecision(2) << estimate.statistical;
    return text.str();
}

std::string order_text(const char* what, const std::optional<Limit>& limit) {
    if (!limit) return "";
    std::ostringstream text;
    text << ", order " << std::setprecision(3) << limit->order << (limit->observed ? " seen" : " assumed") << " in the "
         << what;
    return text.str();
}

}  // namespace

ordered_json convergence_json(const std::vector<LevelRuns>& levels, const std::optional<Estimate>& estimate) {
    ordered_json result;
    const LevelRuns& base = levels.front();
    result["id"] = base.request.at("id");
    result["scheme"] = to_string(base.job.scene.scheme);
    result["precision"] = to_string(base.job.request.precision);
    if (const double amplitude = base.job.request.perturbation.amplitude; amplitude > 0)
        result["perturbation"] = amplitude;
    result["bodyLength"] = base.body_length;
    for (const LevelRuns& runs : levels) {
        ordered_json level;
        level["level"] = runs.level.name;
        level["substeps"] = runs.substeps;
        level["particles"] = runs.particles;
        level["fluidRestDistance"] = runs.job.scene.solver.fluid_rest_distance;
        level["runs"] = runs.distance().runs;
        level["unstable"] = runs.unstable_runs();
        if (runs.distance().runs > 0) {
            level["distance"] = sample_json(runs.distance());
            level["speed"] = sample_json(runs.speed());
            if (const auto relative = relative_change(base.speed(), runs.speed()); relative && &runs != &base)
                level["change"] = sample_json(*relative);
        }
        ordered_json stopped = ordered_json::object();
        for (const json& one : runs.results) {
            const std::string reason = one.at("stopped");
            stopped[reason] = stopped.value(reason, 0) + 1;
        }
        level["stopped"] = stopped;
        result["levels"].push_back(level);
    }
    if (!estimate) return result;
    ordered_json speed = {{"speed", estimate->value},
                          {"error", estimate->error},
                          {"statistical", estimate->statistical},
                          {"discretisation", estimate->discretisation}};
    if (estimate->time) speed["time"] = limit_json(*estimate->time);
    if (estimate->space) speed["spacing"] = limit_json(*estimate->space);
    result["estimate"] = speed;
    return result;
}

std::string convergence_table(const std::vector<LevelRuns>& levels, const std::optional<Estimate>& estimate) {
    std::ostringstream text;
    const auto row = [&](const std::string& level, const std::string& substeps, const std::string& particles,
                         const std::string& runs, const std::string& distance, const std::string& speed,
                         const std::string& change) {
        std::ostringstream line;
        line << std::left << std::setw(11) << level << std::right << std::setw(8) << substeps << std::setw(11)
             << particles << std::setw(6) << runs << "   " << std::left << std::setw(24) << distance << "  "
             << std::setw(24) << speed << "  " << change;
        std::string all = line.str();
        all.erase(all.find_last_not_of(' ') + 1);
        text << all << "\n";
    };
    row("level", "substeps", "particles", "runs", "distance", "speed", "change of speed");
    for (const LevelRuns& runs : levels) {
        const Sample distance = runs.distance(), speed = runs.speed();
        const bool any = distance.runs > 0;
        row(runs.level.name, std::to_string(runs.substeps), std::to_string(runs.particles),
            std::to_string(distance.runs), any ? with_error(distance.mean, distance.error) : "unstable",
            any ? with_error(speed.mean, speed.error) : "",
            any && &runs != &levels.front() ? change_text(levels.front().speed(), speed) : "");
    }
    if (estimate)
        text << "speed at time step and spacing 0: " << with_error(estimate->value, estimate->error)
             << " length/s (scatter " << std::setprecision(2) << scatter_text(*estimate) << ", discretisation "
             << estimate->discretisation << order_text("time step", estimate->time)
             << order_text("spacing", estimate->space) << ")\n";
    for (const LevelRuns& runs : levels)
        if (runs.unstable_runs() > 0)
            text << runs.level.name << ": " << runs.unstable_runs() << " runs were unstable and are left out\n";
    return text.str();
}

}  // namespace natator::cli
