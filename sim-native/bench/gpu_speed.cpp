#include "gpu_speed.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "measure/fnv1a.h"
#include "natator/batch.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/model_builder.h"
#include "speed.h"

namespace natator::bench {
namespace {

/// Gaits about that of the scene, each a little faster and weaker than the one before.
std::vector<BatchMember> members_of(const Scene& scene, int count) {
    std::vector<BatchMember> members;
    for (int k = 0; k < count; ++k) {
        Gait gait = speed_gait(scene);
        const double part = static_cast<double>(k) / count;
        gait.frequency *= 1 + 0.1 * part;
        for (double& amplitude : gait.amplitude) amplitude *= 1 - 0.5 * part;
        members.push_back({gait, {}});
    }
    return members;
}

std::string hash_of(const std::vector<Evaluation>& evaluations) {
    Fnv1a hash;
    for (const Evaluation& evaluation : evaluations) hash.add(std::bit_cast<double>(evaluation.hash));
    return hash_text(hash.value());
}

std::string device_text(int device) {
    const std::vector<Device> devices = cuda_devices();
    if (device >= static_cast<int>(devices.size()))
        throw NoDevice("bench speed: device " + std::to_string(device) + ": no such device here");
    return devices[device].name;
}

/// Least times of the repeats, but of settling the most: it is done once.
struct Measured {
    double whole = std::numeric_limits<double>::infinity();
    BatchTimes device{0, whole};
    std::string hash;
};

BatchOptions options_of(const GpuSpeedStudy& study, Precision precision, BatchTimes& times) {
    return {.precision = precision, .device = study.device, .whole_gpu = study.whole_gpu, .times = &times};
}

Measured measure(const GpuSpeedStudy& study, const Scene& scene, const std::vector<BatchMember>& members,
                 Precision precision) {
    using Clock = std::chrono::steady_clock;
    Measured least;
    for (int k = 0; k < study.repeats; ++k) {
        BatchTimes times;
        const auto start = Clock::now();
        const std::vector<Evaluation> evaluations =
            evaluate_on_gpu(scene, members, options_of(study, precision, times));
        least.whole = std::min(least.whole, std::chrono::duration<double>(Clock::now() - start).count());
        least.device.kernel = std::min(least.device.kernel, times.kernel);
        least.device.settling = std::max(least.device.settling, times.settling);
        const std::string hash = hash_of(evaluations);
        if (!least.hash.empty() && hash != least.hash)
            throw std::runtime_error("two runs differ: " + least.hash + " and " + hash);
        least.hash = hash;
    }
    return least;
}

Row figures(const Scene& scene, std::size_t evaluations, int repeats, const Measured& measured) {
    const Model model = build_model(scene);
    int fluid = 0;
    for (int i = 0; i < model.particles(); ++i) fluid += model.is_fluid(i);
    const double substeps = std::round(scene.duration / scene.time_step) * scene.solver.substeps;
    const double work = static_cast<double>(evaluations) * (fluid > 0 ? fluid : model.particles()) * substeps *
                        scene.solver.numIterations;
    return {std::to_string(model.particles()),
            std::to_string(fluid),
            number_text(substeps),
            std::to_string(scene.solver.numIterations),
            std::to_string(repeats),
            measured_text(measured.device.kernel),
            measured_text(measured.device.settling),
            measured_text(measured.whole),
            measured_text(1e-6 * work / measured.device.kernel),
            measured.hash};
}

Row joined_rows(Row key, const Row& rest) {
    key.insert(key.end(), rest.begin(), rest.end());
    return key;
}

}  // namespace

Row gpu_speed_columns() {
    return {"scene",
            "scheme",
            "precision",
            "evaluations",
            "device",
            "particles",
            "fluid_particles",
            "substeps",
            "iterations",
            "repeats",
            "kernel_seconds",
            "settling_seconds",
            "whole_seconds",
            "million_particle_iterations_per_second",
            "hash"};
}

Row gpu_speed_profile_columns() {
    return {"scene", "scheme", "precision", "evaluations", "device", "stage", "seconds", "share"};
}

void run_gpu_speed_study(const GpuSpeedStudy& study, ResultTable& table, ResultTable& profile,
                         const std::function<void(const std::string&)>& report) {
    const std::string device = device_text(study.device) + (study.whole_gpu ? "; whole" : "");
    for (const std::string& name : study.scenes)
        for (const Scheme scheme : study.schemes) {
            Scene scene = speed_scene(name, study.quick);
            scene.scheme = scheme;
            if (const auto reason = gpu_refusal(scene)) {
                report(name + ": " + *reason);
                continue;
            }
            for (const Precision precision : study.precisions)
                for (const int batch : study.batches) {
                    const Row key{name, to_string(scheme), to_string(precision), std::to_string(batch), device};
                    if (table.has(key)) continue;
                    const std::vector<BatchMember> members = members_of(scene, batch);
                    const Measured measured = measure(study, scene, members, precision);
                    table.add(joined_rows(key, figures(scene, members.size(), study.repeats, measured)));
                    report(joined(table.rows().back(), " "));
                    StageProfile stages;
                    BatchTimes times{.profile = &stages};
                    evaluate_on_gpu(scene, members, options_of(study, precision, times));
                    for (const StageProfile::Entry& entry : stages.entries())
                        profile.add(joined_rows(key, {entry.stage, measured_text(entry.seconds),
                                                      measured_text(entry.seconds / stages.seconds())}));
                }
        }
}

}  // namespace natator::bench
