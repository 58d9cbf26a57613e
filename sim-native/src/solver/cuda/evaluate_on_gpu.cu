#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "batch_kernel.cuh"
#include "device_model.h"
#include "evaluate/law_figures.h"
#include "evaluate/perturb.h"
#include "natator/actuate.h"
#include "natator/batch.h"
#include "natator/error.h"
#include "natator/measure.h"
#include "natator/model_builder.h"

namespace natator {
namespace cuda {
namespace {

/// The States of a batch in device memory.
template <class Real>
struct DeviceStates {
    DeviceStates(const ModelView<Real>& model, int states)
        : count(states),
          position(static_cast<std::size_t>(states) * model.particles),
          velocity(position.size()),
          fit(static_cast<std::size_t>(states) * model.clusters) {}

    int count;
    DeviceBuffer<Quad<Real>> position, velocity;
    DeviceBuffer<ClusterFit<Real>> fit;
};

float as_quad_number(int i, float) {
    float value;
    std::memcpy(&value, &i, sizeof value);
    return value;
}
double as_quad_number(int i, double) {
    const long long wide = i;
    double value;
    std::memcpy(&value, &wide, sizeof value);
    return value;
}
int number_of(float w) {
    int i;
    std::memcpy(&i, &w, sizeof i);
    return i;
}
int number_of(double w) {
    long long i;
    std::memcpy(&i, &w, sizeof i);
    return static_cast<int>(i);
}

/// Advances States of one Model on one device.
template <class Real>
class Batch {
public:
    explicit Batch(const Model& model) : model_(model), device_model_(model), view_(device_model_.view()) {
        on_chip_ = resident_blocks(view_, true) > 0;
        blocks_ = resident_blocks(view_, on_chip_);
        if (blocks_ == 0) throw InputError("backend cuda: the scene has too many springs or clusters for the device");
    }

    /// The members' evaluations, each of a State that starts settled.
    std::vector<Evaluation> evaluate(const Scene& scene, const std::vector<BatchMember>& members) {
        const DeviceStates<Real> starts = settled_starts(scene.settling, members);
        DeviceStates<Real> states(view_, static_cast<int>(members.size()));
        spread(starts, members, states);
        return run(scene, members, states);
    }

private:
    static constexpr int start_of_all = 0;  ///< State of the start that members without a perturbation share

    DeviceStates<Real> settled_starts(const Settling& settling, const std::vector<BatchMember>& members) {
        std::vector<Model> models{model_};
        for (const BatchMember& member : members) {
            if (member.perturbation.amplitude == 0) continue;
            models.push_back(model_);
            perturb(member.perturbation, models.back());
        }
        DeviceStates<Real> starts(view_, static_cast<int>(models.size()));
        upload(models, starts);
        if (settling.updates > 0) {
            BatchView<Real> batch = view_of(starts, settling.updates);
            batch.time_step = settling.time_step;
            batch.substeps = settling.substeps;
            batch.settling = true;
            launch(batch);
        }
        return starts;
    }

    void upload(const std::vector<Model>& models, DeviceStates<Real>& states) {
        std::vector<Quad<Real>> position, velocity;
        std::vector<ClusterFit<Real>> fits;
        for (const Model& model : models) {
            const std::size_t first = position.size();
            position.resize(first + model.particles());
            velocity.resize(first + model.particles());
            for (int i = 0; i < model.particles(); ++i) {
                const int number = device_model_.number_of()[i];
                const auto x = model.position[i].cast<Real>();
                const auto v = model.velocity[i].cast<Real>();
                position[first + number] = {x.x(), x.y(), x.z(), as_quad_number(number, Real())};
                velocity[first + number] = {v.x(), v.y(), v.z(), 0};
            }
            for (const Cluster& cluster : model.clusters) {
                ClusterFit<Real> fit{};
                const auto centre = cluster.centre.cast<Real>();
                fit.centre = {centre.x(), centre.y(), centre.z()};
                for (int e = 0; e < 4; ++e) fit.rotation[e] = static_cast<Real>(cluster.rotation.coeffs()[e]);
                fits.push_back(fit);
            }
        }
        states.position.upload(position);
        states.velocity.upload(velocity);
        states.fit.upload(fits);
    }

    /// Gives each member the settled start that belongs to it.
    void spread(const DeviceStates<Real>& starts, const std::vector<BatchMember>& members,
                DeviceStates<Real>& states) const {
        const auto copy = [](auto& to, const auto& from, std::size_t size, std::size_t member, std::size_t start) {
            check(cudaMemcpyAsync(to.data() + member * size, from.data() + start * size, size * sizeof(*to.data()),
                                  cudaMemcpyDeviceToDevice),
                  "copy");
        };
        std::size_t own = start_of_all;
        for (std::size_t k = 0; k < members.size(); ++k) {
            const std::size_t start = members[k].perturbation.amplitude == 0 ? start_of_all : ++own;
            copy(states.position, starts.position, view_.particles, k, start);
            copy(states.velocity, starts.velocity, view_.particles, k, start);
            if (view_.clusters > 0) copy(states.fit, starts.fit, view_.clusters, k, start);
        }
    }

    BatchView<Real> view_of(DeviceStates<Real>& states, int updates) {
        BatchView<Real> batch{};
        batch.model = view_;
        batch.states = states.count;
        batch.updates = updates;
        batch.position = states.position.data();
        batch.velocity = states.velocity.data();
        batch.fit = states.fit.data();
        return batch;
    }

    /// Runs the updates to their end. Fills in what every launch needs.
    void launch(BatchView<Real>& batch) {
        const int blocks = std::min(blocks_, batch.states);
        batch.scratch_bytes = scratch_bytes(view_, on_chip_);
        if (scratch_.size() < blocks * batch.scratch_bytes) scratch_ = DeviceBuffer<char>(blocks * batch.scratch_bytes);
        batch.scratch = scratch_.data();
        const std::vector<Progress> running(batch.states);
        progress_ = DeviceBuffer<Progress>(running);
        path_ = DeviceBuffer<double>(static_cast<std::size_t>(batch.states) * (batch.updates + 1));
        DeviceBuffer<unsigned> next_ticket(1);
        DeviceBuffer<int> updates_done(batch.states);
        next_ticket.clear();
        updates_done.clear();
        batch.progress = progress_.data();
        batch.path = path_.data();
        batch.next_ticket = next_ticket.data();
        batch.updates_done = updates_done.data();
        launch_batch(batch, on_chip_, blocks);
        check(cudaDeviceSynchronize(), "run");
    }

    std::vector<Evaluation> run(const Scene& scene, const std::vector<BatchMember>& members,
                                DeviceStates<Real>& states) {
        std::vector<double> frequency, power, amplitude, phase;
        for (const BatchMember& member : members) {
            frequency.push_back(member.gait.frequency);
            power.push_back(member.gait.power);
            amplitude.insert(amplitude.end(), member.gait.amplitude.begin(), member.gait.amplitude.end());
            phase.insert(phase.end(), member.gait.phase.begin(), member.gait.phase.end());
        }
        const DeviceBuffer<double> frequencies(frequency), powers(power), amplitudes(amplitude), phases(phase);
        DeviceBuffer<Real> density(static_cast<std::size_t>(states.count) * view_.fluid);
        density.clear();

        const int frames = static_cast<int>(std::lround(scene.duration / scene.time_step));
        const bool swims = !model_.body.particles.empty();
        BatchView<Real> batch = view_of(states, frames);
        batch.time_step = scene.time_step;
        batch.substeps = scene.solver.substeps;
        batch.gait = {frequencies.data(), powers.data(), amplitudes.data(), phases.data()};
        batch.density = density.data();
        batch.stop_at_planes = scene.stopping.plane_contact;
        batch.no_progress_frames =
            swims ? static_cast<int>(std::lround(scene.stopping.no_progress_after / scene.time_step)) : 0;
        launch(batch);

        const std::vector<Progress> progress = progress_.download();
        const std::vector<double> path = path_.download();
        const std::vector<Quad<Real>> position = states.position.download(), velocity = states.velocity.download();
        const std::vector<Real> densities = density.download();
        std::vector<Evaluation> evaluations;
        for (int k = 0; k < states.count; ++k) {
            const std::size_t first = static_cast<std::size_t>(k) * view_.particles;
            evaluations.push_back(evaluation_of(scene, progress[k], &path[static_cast<std::size_t>(k) * (frames + 1)],
                                                &position[first], &velocity[first],
                                                densities.data() + static_cast<std::size_t>(k) * view_.fluid));
        }
        return evaluations;
    }

    Evaluation evaluation_of(const Scene& scene, const Progress& progress, const double* path,
                             const Quad<Real>* position, const Quad<Real>* velocity, const Real* densities) const {
        std::vector<int> slot_of(view_.particles);
        for (int s = 0; s < view_.particles; ++s) slot_of[number_of(position[s].w)] = s;
        State<Real> state = initial_state<Real>(model_);
        std::vector<Real> density(view_.particles, Real(0));
        for (int i = 0; i < view_.particles; ++i) {
            const int number = device_model_.number_of()[i];
            const Quad<Real>&x = position[slot_of[number]], &v = velocity[slot_of[number]];
            state.position[i] = {x.x, x.y, x.z};
            state.velocity[i] = {v.x, v.y, v.z};
            if (number < view_.fluid && model_.inverse_mass[i] > 0) density[i] = densities[number];
        }
        Evaluation evaluation;
        evaluation.frames = progress.frames;
        evaluation.simulated = progress.frames * scene.time_step;
        evaluation.distance = progress.frames > 0 ? path[progress.frames] - path[0] : 0;
        evaluation.hash = state_hash(state);
        if (progress.stopped >= 0) evaluation.stopped = static_cast<Stopped>(progress.stopped);
        if (evaluation.stopped == Stopped::unstable) {
            const auto& numbers = device_model_.number_of();
            const auto bad = std::find(numbers.begin(), numbers.end(), progress.bad_particle);
            evaluation.instability = {static_cast<int>(bad - numbers.begin()), "substep", progress.bad_time};
        } else {
            evaluation.laws = law_figures(model_, state, density);
        }
        return evaluation;
    }

    const Model& model_;
    DeviceModel<Real> device_model_;
    const ModelView<Real>& view_;
    bool on_chip_ = false;
    int blocks_ = 0;
    DeviceBuffer<char> scratch_;
    DeviceBuffer<Progress> progress_;
    DeviceBuffer<double> path_;
};

/// What has no stage on the device.
std::optional<std::string> refusal(const Model& model) {
    const Plan plan = make_plan(model);
    if (model.scheme != Scheme::flex) return "scheme \"conserving\" is not done on the GPU yet; must be \"flex\"";
    if (model.particles() == 0) return "the scene has no particles; must have some";
    if (model.particles() > 65535)
        return std::to_string(model.particles()) + " particles are not done on the GPU yet; must be at most 65535";
    if (model.planes.size() > most_planes)
        return std::to_string(model.planes.size()) + " planes; must be at most " + std::to_string(most_planes);
    const std::pair<bool, const char*> effects[] = {{plan.restitution, "restitution"},
                                                    {plan.adhesion, "adhesion"},
                                                    {plan.sleep, "sleepThreshold"},
                                                    {plan.shock_propagation, "shockPropagation"},
                                                    {plan.dissipation, "dissipation"},
                                                    {plan.cohesion, "cohesion"},
                                                    {plan.surface_tension, "surfaceTension"},
                                                    {plan.vorticity, "vorticityConfinement"},
                                                    {plan.free_surface_drag, "freeSurfaceDrag"}};
    for (const auto& [used, name] : effects)
        if (used) return std::string(name) + " is not done on the GPU; must be 0";
    return std::nullopt;
}

/// In halves where the whole does not fit into the device's memory.
template <class Real>
std::vector<Evaluation> evaluate_in_parts(Batch<Real>& batch, const Scene& scene,
                                          const std::vector<BatchMember>& members) {
    try {
        return batch.evaluate(scene, members);
    } catch (const std::bad_alloc&) {
        if (members.size() < 2) throw;
    }
    const auto middle = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
    std::vector<Evaluation> all = evaluate_in_parts(batch, scene, {members.begin(), middle});
    const std::vector<Evaluation> rest = evaluate_in_parts(batch, scene, {middle, members.end()});
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

}  // namespace
}  // namespace cuda

std::vector<Device> cuda_devices() {
    int count = 0;
    if (cudaGetDeviceCount(&count) != cudaSuccess) {
        cudaGetLastError();
        return {};
    }
    std::vector<Device> devices;
    for (int i = 0; i < count; ++i) {
        cudaDeviceProp properties{};
        cuda::check(cudaGetDeviceProperties(&properties, i), "device properties");
        devices.push_back({i, properties.name,
                           std::to_string(properties.major) + "." + std::to_string(properties.minor),
                           properties.totalGlobalMem, properties.multiProcessorCount});
    }
    return devices;
}

std::optional<std::string> gpu_refusal(const Scene& scene) {
    return cuda::refusal(build_model(scene));
}

std::vector<Evaluation> evaluate_on_gpu(const Scene& scene, const std::vector<BatchMember>& members,
                                        Precision precision, int device) {
    const int devices = static_cast<int>(cuda_devices().size());
    if (device < 0 || device >= devices)
        throw NoDevice("backend cuda: device " + std::to_string(device) + ": no such device; there " +
                       (devices == 1 ? "is 1 GPU" : "are " + std::to_string(devices) + " GPUs"));
    for (const BatchMember& member : members) check_gait(member.gait, scene.creature ? scene.creature->actuators() : 0);
    if (members.empty()) return {};
    cuda::check(cudaSetDevice(device), "choose device");
    const Model model = build_model(scene);
    if (const auto reason = cuda::refusal(model)) throw InputError("backend cuda: " + *reason);
    if (precision == Precision::double_precision) {
        cuda::Batch<double> batch(model);
        return cuda::evaluate_in_parts(batch, scene, members);
    }
    cuda::Batch<float> batch(model);
    return cuda::evaluate_in_parts(batch, scene, members);
}

}  // namespace natator
