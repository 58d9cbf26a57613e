#include <string>

#include "base/text.h"
#include "natator/cost.h"
#include "natator/error.h"
#include "particle_experiment.h"
#include "solver/gpu_solver.h"

namespace natator {
namespace {

using nlohmann::json;

/// Single precision is written with the digits that read back exactly, not with those of its double.
json value_of(double value) {
    return value;
}
json value_of(float value) {
    return std::stod(number_text(value));
}

template <class Vector>
json row_of(const Vector& vector) {
    json row = json::array();
    for (Eigen::Index k = 0; k < vector.size(); ++k) row.push_back(value_of(vector[k]));
    return row;
}

template <class Real>
json rows_of(const std::vector<Vector3<Real>>& vectors) {
    json rows = json::array();
    for (const auto& vector : vectors) rows.push_back(row_of(vector));
    return rows;
}

/// Records what Flex' callbacks saw: predicted positions, positions after each iteration, velocities at the end.
template <class Real>
class TraceRecorder : public StepObserver<Real> {
public:
    void predicted(const std::vector<Vector3<Real>>& positions) override {
        trace.push_back({{"predicted", rows_of(positions)}, {"iterations", json::array()}});
    }
    void iterated(const std::vector<Vector3<Real>>& positions) override {
        trace.back()["iterations"].push_back(rows_of(positions));
    }
    void substep_ended(const std::vector<Vector3<Real>>& velocities) override {
        trace.back()["velocity_raw"] = rows_of(velocities);
    }

    json trace = json::array();
};

/// One entry of the result's `frames`, with the fields that `asked` has.
template <class Real, class AnySolver>
json frame_of(const json& asked, const State<Real>& state, AnySolver& solver, json trace) {
    json frame{{"frame", asked.at("frame")}, {"pos", rows_of(state.position)}, {"vel", rows_of(state.velocity)}};
    if (asked.contains("density")) {
        frame["density"] = json::array();
        for (const Real density : solver.densities()) frame["density"].push_back(value_of(density));
    }
    if (asked.contains("neighbors")) frame["neighbors"] = solver.neighbour_counts();
    if (asked.contains("rot")) {
        frame["rot"] = json::array();
        for (const auto& rotation : state.cluster_rotation) frame["rot"].push_back(row_of(rotation.coeffs()));
    }
    if (asked.contains("trans")) frame["trans"] = rows_of(state.cluster_centre);
    if (asked.contains("first_substep")) frame["first_substep"] = trace.at(0);
    if (asked.contains("substeps_trace")) frame["substeps_trace"] = std::move(trace);
    return frame;
}

/// Whether the positions of every iteration are asked for.
bool is_traced(const json& asked) {
    return asked.contains("substeps_trace") || asked.contains("first_substep");
}

template <class Real, class AnySolver>
json run_frames(const ParticleExperiment& experiment, const json& requested_frames, AnySolver solver) {
    State<Real> state = initial_state<Real>(experiment.model);
    json frames = json::array();
    long updates = 0;
    for (const json& asked : requested_frames) {
        TraceRecorder<Real> recorder;
        const bool traced = is_traced(asked);
        while (updates < asked.at("frame").get<long>()) {
            ++updates;
            const bool last = updates == asked.at("frame").get<long>();
            const auto bad =
                solver.update(state, experiment.time_step, experiment.substeps, traced && last ? &recorder : nullptr);
            if (!bad) continue;
            frames.push_back({{"frame", updates},
                              {"unstable", {{"particle", bad->particle}, {"stage", bad->stage}, {"time", bad->time}}}});
            return frames;
        }
        frames.push_back(frame_of(asked, state, solver, std::move(recorder.trace)));
    }
    return frames;
}

/// Refuses what would take too long or too much memory, results included.
void check_experiment_cost(const ParticleExperiment& experiment, const json& requested_frames,
                           const std::string& where) {
    constexpr double bytes_of_row = 120;  // three numbers in JSON
    double rows = 0, updates = 0;
    for (const json& asked : requested_frames) {
        const double steps = is_traced(asked) ? experiment.substeps : 0;
        rows += 3 + steps * (2 + experiment.model.parameters.iterations);
        updates = asked.at("frame").get<double>();
    }
    check_cost(experiment.model, updates * experiment.substeps, bytes_of_row * rows * experiment.model.particles(),
               where);
}

/// The frames to record: as the input lists them, each number larger than the one before.
json requested_frames(const json& experiment, const std::string& where) {
    json frames = experiment.value("frames", json::array({{{"frame", 1}}}));
    long last = 0;
    if (!frames.is_array())
        throw InputError(where + ": frames = " + shown(frames) + ": must be an array of objects with a frame number");
    for (const json& frame : frames) {
        if (!frame.is_object() || !frame.contains("frame") || !frame["frame"].is_number_integer() ||
            frame["frame"].get<long>() <= last)
            throw InputError(where + ": frames = " + shown(frames) +
                             ": must be objects whose frame numbers are 1 or more and increase");
        last = frame["frame"];
    }
    return frames;
}

}  // namespace

json run_particle_experiment(const json& source, const std::string& where, Precision precision,
                             std::optional<int> gpu) {
    const ParticleExperiment experiment = read_particle_experiment(source, where);
    const json asked = requested_frames(source, where);
    check_experiment_cost(experiment, asked, where);
    const auto frames = [&](auto real) {
        using Real = decltype(real);
        return gpu ? run_frames<Real>(experiment, asked, GpuSolver<Real>(experiment.model, {.device = *gpu}))
                   : run_frames<Real>(experiment, asked, Solver<Real>(experiment.model));
    };
    json result = source;
    result["frames"] = precision == Precision::double_precision ? frames(double{}) : frames(float{});
    return result;
}

}  // namespace natator
