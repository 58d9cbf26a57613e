#include "solver/gpu_solver.h"

#include "batch_runner.h"
#include "natator/batch.h"

namespace natator {
namespace cuda {
namespace {

/// Room for what an observer sees of one update.
template <class Real>
class TraceBuffers {
public:
    TraceBuffers(const ModelView<Real>& model, int substeps)
        : model_(model),
          substeps_(substeps),
          predicted_(static_cast<std::size_t>(substeps) * model.particles),
          iterated_(predicted_.size() * model.iterations),
          velocity_(predicted_.size()) {}

    Trace<Real> view() const { return {predicted_.data(), iterated_.data(), velocity_.data()}; }

    void tell(const DeviceModel<Real>& model, StepObserver<Real>& observer) const {
        const std::vector<Quad<Real>> predicted = predicted_.download(), iterated = iterated_.download(),
                                      velocity = velocity_.download();
        for (int k = 0; k < substeps_; ++k) {
            const std::size_t first = static_cast<std::size_t>(k) * model_.particles;
            observer.predicted(by_particle(model, &predicted[first], &predicted[first]));
            const Quad<Real>* numbers = nullptr;
            for (int i = 0; i < model_.iterations; ++i) {
                numbers = &iterated[first * model_.iterations + static_cast<std::size_t>(i) * model_.particles];
                observer.iterated(by_particle(model, numbers, numbers));
            }
            observer.substep_ended(by_particle(model, &velocity[first], numbers));
        }
    }

private:
    const ModelView<Real>& model_;
    int substeps_;
    DeviceBuffer<Quad<Real>> predicted_, iterated_, velocity_;
};

}  // namespace
}  // namespace cuda

template <class Real>
class GpuSolver<Real>::Implementation {
public:
    explicit Implementation(const Model& model) : model_(model), runner_(model), states_(runner_.model(), 1) {}

    std::optional<Instability> update(State<Real>& state, double time_step, int substeps, StepObserver<Real>* observer,
                                      const Gait* gait) {
        const cuda::ModelView<Real>& view = runner_.model().view();
        states_.upload({state});
        const auto row = [](double value) { return std::vector<double>{value}; };
        using Numbers = cuda::DeviceBuffer<double>;
        const Numbers frequency(row(gait ? gait->frequency : 0)), power(row(gait ? gait->power : 1)),
            amplitude(gait ? gait->amplitude : row(0)), phase(gait ? gait->phase : row(0));
        cuda::BatchView<Real> batch = runner_.view_of(states_, 1);
        batch.start_time = state.time;
        batch.time_step = time_step;
        batch.substeps = substeps;
        if (gait) batch.gait = {frequency.data(), power.data(), amplitude.data(), phase.data()};
        cuda::DeviceBuffer<Real> density(view.fluid);
        cuda::DeviceBuffer<int> neighbours(view.particles);
        batch.density = density.data();
        batch.neighbours = neighbours.data();
        std::optional<cuda::TraceBuffers<Real>> trace;
        if (observer) batch.trace = trace.emplace(view, substeps).view();
        runner_.run(batch, {cuda::Progress{}});

        const cuda::Progress progress = runner_.progress().front();
        const double start = state.time;
        state = typename cuda::DeviceStates<Real>::Copy(states_).state(0, state);
        if (progress.stopped >= 0) {
            state.time = progress.bad_time;
            const auto& particle_of = runner_.model().particle_of();
            const int bad = progress.bad_particle < view.particles ? particle_of[progress.bad_particle] : 0;
            return cuda::located(model_, state, gait, time_step, substeps, start, {bad, "velocities", state.time});
        }
        state.time = start + time_step;
        densities_ = density.download();
        neighbours_ = neighbours.download();
        if (observer) trace->tell(runner_.model(), *observer);
        return std::nullopt;
    }

    std::vector<Real> densities() const {
        std::vector<Real> densities(model_.particles(), Real(0));
        for (std::size_t k = 0; k < densities_.size(); ++k) {
            const int i = runner_.model().particle_of()[k];
            if (model_.inverse_mass[i] > 0) densities[i] = densities_[k];
        }
        return densities;
    }

    std::vector<int> neighbour_counts() const {
        std::vector<int> counts(model_.particles(), 0);
        for (std::size_t k = 0; k < neighbours_.size(); ++k) counts[runner_.model().particle_of()[k]] = neighbours_[k];
        return counts;
    }

    const Model& model() const { return model_; }

private:
    const Model& model_;
    cuda::BatchRunner<Real> runner_;
    cuda::DeviceStates<Real> states_;
    std::vector<Real> densities_;  ///< of the last update, by device number
    std::vector<int> neighbours_;
};

template <class Real>
GpuSolver<Real>::GpuSolver(const Model& model, int device) {
    cuda::choose_device(device);
    if (const auto reason = cuda::refusal(model)) throw InputError("backend cuda: " + *reason);
    implementation_ = std::make_unique<Implementation>(model);
}
template <class Real>
GpuSolver<Real>::~GpuSolver() = default;
template <class Real>
GpuSolver<Real>::GpuSolver(GpuSolver&&) noexcept = default;
template <class Real>
GpuSolver<Real>& GpuSolver<Real>::operator=(GpuSolver&&) noexcept = default;

template <class Real>
std::optional<Instability> GpuSolver<Real>::update(State<Real>& state, double time_step, int substeps,
                                                   StepObserver<Real>* observer) {
    return implementation_->update(state, time_step, substeps, observer, nullptr);
}

template <class Real>
std::optional<Instability> GpuSolver<Real>::frame(State<Real>& state, const Gait& gait) {
    const Model& model = implementation_->model();
    return implementation_->update(state, model.time_step, model.parameters.substeps, nullptr, &gait);
}

template <class Real>
std::vector<Real> GpuSolver<Real>::densities() const {
    return implementation_->densities();
}

template <class Real>
std::vector<int> GpuSolver<Real>::neighbour_counts() const {
    return implementation_->neighbour_counts();
}

template class GpuSolver<float>;
template class GpuSolver<double>;

}  // namespace natator
