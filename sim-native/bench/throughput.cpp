#include "throughput.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "bench_scenes.h"
#include "in_precision.h"
#include "natator/model.h"
#include "run/cuda/uses_grid_kernels.h"
#include "run/settle.h"
#include "scene/scene_json.h"
#include "solver/gpu_solver.h"
#include "timed_batch.h"

namespace natator::bench {
namespace {

constexpr double spacing = 0.1;  // fluid_rest_distance of the thesis

Scene scene_of(const std::array<int, 3>& count) {
    constexpr double rear = 0.45, high = 0.6, aside = 0.6;
    nlohmann::json overrides = thesis_tank_with(count, spacing);
    overrides["creature"]["rearCentre"] = {rear, std::min(high, spacing * count[1]), aside};
    overrides["settling"]["updates"] = 12;
    overrides["stopping"] = {{"planeContact", false}, {"noProgressAfter", 0}};
    return load_scene("thesis/creature-1", overrides);
}

/// Mean over the fluid.
template <class Real>
double mean_neighbours(const Scene& scene, const Model& model, const ThroughputStudy& study) {
    GpuSolver<Real> solver(model,
                           {.device = study.device, .path = study.whole_gpu ? GpuPath::whole_gpu : GpuPath::by_size});
    State<Real> state = initial_state<Real>(model);
    settle(scene.settling, solver, state);
    solver.update(state, model.time_step, model.parameters.substeps);
    const std::vector<int> counts = solver.neighbour_counts();
    double sum = 0;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) sum += counts[static_cast<std::size_t>(i)];
    return sum / fluid_particles(model);
}

/// A tank of one size in one scheme, setting and precision, for batches of all sizes.
class Tank {
public:
    Tank(const ThroughputStudy& study, Scheme scheme, const std::optional<Steps>& steps, Precision precision,
         int particles)
        : study_(study), precision_(precision), particles_(particles), scene_(throughput_scene(particles)) {
        scene_.scheme = scheme;
        if (steps) set_steps(*steps, scene_.solver);
        model_ = build_model(scene_);
        fluid_ = fluid_particles(model_);
    }

    Row key(int batch, const std::string& device) const {
        return {to_string(scene_.scheme),
                to_string(precision_),
                std::to_string(fluid_),
                std::to_string(batch),
                device,
                path(),
                std::to_string(model_.particles()),
                std::to_string(model_.parameters.substeps),
                std::to_string(model_.parameters.iterations),
                scene_.scheme == Scheme::conserving ? yes_or_no(model_.parameters.conserving.modified_pressure) : ""};
    }

    /// What stands behind the key, or why nothing does.
    std::variant<Row, std::string> measure(int batch) {
        const int frames = study_.quick ? 2 : throughput_frames(scene_.scheme, particles_, batch);
        scene_.duration = frames * scene_.time_step;
        const TimedBatch timed = time_batch(scene_, batch_members(scene_, batch), options(), study_.repeats);
        if (timed.instability) return "becomes unstable at " + number_text(timed.instability->time) + " s";
        const int substeps = model_.parameters.substeps, iterations = model_.parameters.iterations;
        const double particle_substeps = static_cast<double>(batch) * fluid_ * frames * substeps;
        const double million_per_second = 1e-6 * particle_substeps / timed.device.kernel;
        const double on_device = static_cast<double>(timed.device.at_a_time) * model_.particles();
        return Row{std::to_string(frames),
                   std::to_string(study_.repeats),
                   measured_text(neighbours()),
                   std::to_string(pair_passes(model_)),
                   measured_text(timed.device.kernel),
                   measured_text(1e3 * timed.device.kernel / frames),
                   measured_text(million_per_second * iterations),
                   measured_text(million_per_second * neighbours() * pair_passes(model_)),
                   std::to_string(timed.device.at_a_time),
                   measured_text(static_cast<double>(timed.device.memory) / on_device),
                   timed.hash};
    }

private:
    std::string path() const {
        if (!cuda::uses_grid_kernels(scene_, model_, options())) return "block";
        return study_.without_lists && scene_.scheme == Scheme::conserving ? "whole GPU without lists" : "whole GPU";
    }
    BatchOptions options() const {
        return {.precision = precision_,
                .device = study_.device,
                .whole_gpu = study_.whole_gpu,
                .without_lists = study_.without_lists};
    }
    double neighbours() {
        if (!neighbours_)
            neighbours_ = in_precision(
                precision_, [&](auto real) { return mean_neighbours<decltype(real)>(scene_, model_, study_); });
        return *neighbours_;
    }

    const ThroughputStudy& study_;
    Precision precision_;
    int particles_;
    Scene scene_;
    Model model_;
    int fluid_ = 0;
    std::optional<double> neighbours_;
};

void measure_row(Tank& tank, int batch, const Row& key, ResultTable& table,
                 const std::function<void(const std::string&)>& report) {
    const std::string name = joined(key, " ");
    try {
        const auto measured = tank.measure(batch);
        if (const auto* const reason = std::get_if<std::string>(&measured)) return report(name + ": " + *reason);
        table.add(joined_rows(key, std::get<Row>(measured)));
        report(joined(table.rows().back(), " "));
    } catch (const std::bad_alloc&) {
        report(name + ": needs more memory than there is");
    }
}

}  // namespace

std::vector<int> throughput_particles() {
    return {1000, 2000, 4000, 5660, 8000, 16000, 32000, 64000, 125000, 250000, 500000, 1000000};
}

std::vector<int> throughput_batches() {
    return {1, 4, 16, 64, 150};
}

Scene throughput_scene(int particles) {
    const double scale = std::cbrt(particles / (50.0 * 7 * 17));
    const auto scaled = [scale](int count) { return static_cast<int>(std::lround(scale * count)); };
    std::array<int, 3> count{0, scaled(7), scaled(17)};
    const int layer = count[1] * count[2];
    const auto layers = [layer](int fluid) {
        return static_cast<int>(std::lround(fluid / static_cast<double>(layer)));
    };
    count[0] = layers(particles);
    constexpr int max_room_of_swimmer = 500;  // lattice points nearer to it than the clearance
    if (layer < 2 * max_room_of_swimmer) count[0] += layers(particles - fluid_particles(build_model(scene_of(count))));
    return scene_of(count);
}

int throughput_frames(Scheme scheme, int particles, int batch) {
    const double particle_iterations = scheme == Scheme::flex ? 1e9 : 2e8;
    const double of_frame = 4.0 * 4 * particles * batch;
    return static_cast<int>(std::lround(std::clamp(particle_iterations / of_frame, 4.0, 240.0)));
}

int pair_passes(const Model& model) {
    const SolverParameters& p = model.parameters;
    if (model.scheme == Scheme::flex) return 2 * p.iterations + (p.flex.viscosity != 0 ? 1 : 0);
    return 2 * p.iterations + 4 + (p.conserving.kinematic_viscosity > 0 ? 1 : 0);
}

Row throughput_columns() {
    return fields(
        "scheme,precision,fluid_particles,evaluations,device,path,particles,substeps,iterations,"
        "modified_pressure,frames,repeats,neighbours,pair_passes,kernel_seconds,ms_per_frame,"
        "million_particle_iterations_per_second,million_pairs_per_second,at_a_time,bytes_per_particle,"
        "hash");
}

void run_throughput_study(const ThroughputStudy& study, ResultTable& table,
                          const std::function<void(const std::string&)>& report) {
    const std::string device = gpu_name(study.device);
    for (const int particles : study.particles)
        for (const Scheme scheme : study.schemes)
            for (const std::optional<Steps>& steps : study.settings)
                for (const Precision precision : study.precisions) {
                    Tank tank(study, scheme, steps, precision, particles);
                    for (const int batch : study.batches) {
                        if (batch > 1 && std::int64_t{particles} * batch > max_particles_of_batch) continue;
                        const Row key = tank.key(batch, device);
                        if (!table.has(key)) measure_row(tank, batch, key, table, report);
                    }
                }
}

}  // namespace natator::bench
