#include "fetch_roof.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "grid_runner.h"
#include "natator/error.h"
#include "natator/model.h"
#include "solver/cuda/device.h"
#include "solver/cuda/event.h"
#include "solver/cuda/refusal.h"

namespace natator::cuda {
namespace {

using FetchRunner = GridRunner<float>;

void run_stable(FetchRunner& runner, const FetchRunner::Update& update, StageProfile* profile = nullptr) {
    for (const FetchRunner::End& end : runner.run(update, profile))
        if (!end.finite) throw std::runtime_error("roofline: the run is unstable");
}

double seconds_in(const StageProfile& profile, Stage stage) {
    for (const StageProfile::Entry& entry : profile.entries())
        if (entry.stage == name(stage)) return entry.seconds;
    throw std::runtime_error(std::string("roofline: no stage ") + name(stage));
}

}  // namespace

FetchRoof measure_fetch_roof(const Scene& scene, const std::vector<Gait>& gaits, int frames, int device) {
    choose_device(device);
    const Model model = build_model(scene);
    if (const auto reason = refusal(model)) throw InputError("backend cuda: " + *reason);
    FetchRunner runner(model, static_cast<int>(gaits.size()), {.lists = WaterLists::always});
    for (int k = 0; k < runner.states(); ++k) runner.upload(k, initial_state<float>(model));
    const Settling& settling = scene.settling;
    for (int k = 0; k < settling.updates; ++k) run_stable(runner, {settling.time_step, settling.substeps, {}, true});
    FetchRunner::Update frame{scene.time_step, model.parameters.substeps, {}, false};
    for (const Gait& gait : gaits) frame.muscles.push_back({[&](double time) { return drive(model, gait, time); }, 0});
    run_stable(runner, frame);
    FetchRoof roof;
    StageProfile profile;
    for (int k = 1; k <= frames; ++k) {
        for (auto& muscles : frame.muscles) muscles.start_time = k * scene.time_step;
        run_stable(runner, frame, &profile);
        const std::vector<int> counts = runner.neighbour_counts();
        roof.pairs += std::accumulate(counts.begin(), counts.end(), 0.0) / frames;
    }
    const double passes = static_cast<double>(frames) * model.parameters.substeps * model.parameters.iterations;
    roof.density_constraint = seconds_in(profile, Stage::density_constraint) / passes;
    roof.velocities = runner.fetch_seconds(Fetch::velocities);
    roof.impulses = runner.fetch_seconds(Fetch::impulses);
    return roof;
}

double measure_copy_bandwidth(int device) {
    choose_device(device);
    constexpr std::size_t bytes = std::size_t{1} << 30;
    const DeviceBuffer<char> from(bytes), to(bytes);
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 20; ++round) {
        const Event start, end;
        start.record();
        check(cudaMemcpyAsync(to.data(), from.data(), bytes, cudaMemcpyDeviceToDevice, nullptr), "copy");
        end.record();
        wait_for_uploads();
        least = std::min(least, end.seconds_since(start));
    }
    return 2 * static_cast<double>(bytes) / least;
}

}  // namespace natator::cuda
