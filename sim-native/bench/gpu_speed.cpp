#include "gpu_speed.h"

#include "bench_scenes.h"
#include "natator/batch.h"
#include "timed_batch.h"

namespace natator::bench {
namespace {

BatchOptions options_of(const GpuSpeedStudy& study, Precision precision) {
    return {.precision = precision,
            .device = study.device,
            .whole_gpu = study.whole_gpu,
            .without_lists = study.without_lists};
}

Row figures(const Scene& scene, std::size_t evaluations, int repeats, const TimedBatch& measured) {
    const SpeedWork work = speed_work(scene);
    const double particle_iterations = static_cast<double>(evaluations) * work.particle_iterations;
    return joined_rows(work.columns,
                       {std::to_string(repeats), measured_text(measured.device.kernel),
                        measured_text(measured.device.settling), measured_text(measured.whole),
                        measured_text(1e-6 * particle_iterations / measured.device.kernel), measured.hash});
}

}  // namespace

Row gpu_speed_columns() {
    return fields(
        "scene,scheme,precision,evaluations,device,particles,fluid_particles,substeps,iterations,repeats,"
        "kernel_seconds,settling_seconds,whole_seconds,million_particle_iterations_per_second,hash");
}

Row gpu_speed_profile_columns() {
    return {"scene", "scheme", "precision", "evaluations", "device", "stage", "seconds", "share"};
}

void run_gpu_speed_study(const GpuSpeedStudy& study, ResultTable& table, ResultTable& profile,
                         const std::function<void(const std::string&)>& report) {
    const std::string device =
        gpu_name(study.device) + (study.whole_gpu ? "; whole" : "") + (study.without_lists ? "; without lists" : "");
    for (const SpeedScene& named : study.scenes)
        for (const Scheme scheme : study.schemes) {
            Scene scene = make_speed_scene(named, study.quick);
            scene.scheme = scheme;
            if (const auto reason = gpu_refusal(scene)) {
                report(named.text() + ": " + *reason);
                continue;
            }
            for (const Precision precision : study.precisions)
                for (const int batch : study.batches) {
                    const Row key{named.text(), to_string(scheme), to_string(precision), std::to_string(batch), device};
                    if (table.has(key)) continue;
                    const std::vector<BatchMember> members = batch_members(scene, batch);
                    BatchOptions options = options_of(study, precision);
                    const TimedBatch measured = time_batch(scene, members, options, study.repeats);
                    table.add(joined_rows(key, figures(scene, members.size(), study.repeats, measured)));
                    report(joined(table.rows().back(), " "));
                    StageProfile stages;
                    BatchTimes times{.profile = &stages};
                    options.times = &times;
                    evaluate_on_gpu(scene, members, options);
                    for (const StageProfile::Entry& entry : stages.entries())
                        profile.add(joined_rows(key, {entry.stage, measured_text(entry.seconds),
                                                      measured_text(entry.seconds / stages.seconds())}));
                }
        }
}

}  // namespace natator::bench
