#include "gpu_solver.h"

#include <utility>

#include "base/byte_reader.h"
#include "base/byte_writer.h"
#include "cuda/device.h"
#include "cuda/grid/grid_runner.h"
#include "cuda/kernel_choice.h"
#include "cuda/refusal.h"
#include "flex/cuda/batch_runner.h"
#include "model/check_gait.h"
#include "model/check_model.h"
#include "natator/error.h"
#include "natator/model.h"

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

    void report_to(const DeviceModel<Real>& model, StepObserver<Real>& observer) const {
        const std::vector<Vec4<Real>> predicted = predicted_.download(), iterated = iterated_.download(),
                                      velocity = velocity_.download();
        for (int k = 0; k < substeps_; ++k) {
            const std::size_t first = static_cast<std::size_t>(k) * model_.particles;
            observer.predicted(by_particle(model, &predicted[first], &predicted[first]));
            const Vec4<Real>* numbers = nullptr;
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
    DeviceBuffer<Vec4<Real>> predicted_, iterated_, velocity_;
};

}  // namespace
}  // namespace cuda

template <class Real>
class GpuSolver<Real>::Implementation {
public:
    explicit Implementation(const Model& model) : model_(model) {}
    virtual ~Implementation() = default;

    std::optional<Instability> update(State<Real>& state, double time_step, int substeps, StepObserver<Real>* observer,
                                      const Gait* gait) {
        check_state(model_, state);
        check_step(time_step, substeps);
        if (gait) check_lengths(*gait, model_.actuators);
        std::optional<cuda::TraceBuffers<Real>> trace;
        if (observer) trace.emplace(device_model().view(), substeps);
        const double start = state.time;
        const cuda::Progress progress =
            run(state, time_step, substeps, gait, trace ? trace->view() : cuda::Trace<Real>{});
        if (progress.stopped >= 0) {
            state.time = progress.bad_time;
            const int bad =
                progress.bad_particle < model_.particles() ? device_model().particle_of()[progress.bad_particle] : 0;
            return cuda::located(model_, state, gait, time_step, substeps, start, {bad, "velocities", state.time});
        }
        state.time = start + time_step;
        if (observer) trace->report_to(device_model(), *observer);
        return std::nullopt;
    }

    std::vector<Real> densities() const {
        std::vector<Real> densities(model_.particles(), Real(0));
        for (std::size_t k = 0; k < densities_.size(); ++k) {
            const int i = device_model().particle_of()[k];
            if (model_.inverse_mass[i] > 0) densities[i] = densities_[k];
        }
        return densities;
    }

    double muscle_work() const { return muscle_work_; }
    void clear_muscle_work() { muscle_work_ = 0; }
    std::string save() const {
        ByteWriter saved;
        saved.add(muscle_work_);
        return saved.take();
    }
    void restore(std::string_view saved) {
        ByteReader from(saved);
        double work = 0;
        from.read(work);
        from.require_end();
        muscle_work_ = work;
    }

    std::vector<int> neighbour_counts() const {
        std::vector<int> counts(model_.particles(), 0);
        for (std::size_t k = 0; k < neighbours_.size(); ++k) counts[device_model().particle_of()[k]] = neighbours_[k];
        return counts;
    }

    virtual std::vector<Real> pressures() const { return {}; }
    virtual std::vector<Vector3<Real>> forces() const { return {}; }

    const Model& model() const { return model_; }

protected:
    virtual const cuda::DeviceModel<Real>& device_model() const = 0;
    /// One update of `state`, and of what is kept of it by device number; its time stays.
    virtual cuda::Progress run(State<Real>& state, double time_step, int substeps, const Gait* gait,
                               const cuda::Trace<Real>& trace) = 0;

    const Model& model_;
    std::vector<Real> densities_;
    std::vector<int> neighbours_;
    double muscle_work_ = 0;  ///< of frames; scheme `flex` has none
};

template <class Real>
class GpuSolver<Real>::BlockSolver : public Implementation {
public:
    explicit BlockSolver(const Model& model)
        : Implementation(model), runner_(model), states_(runner_.model(), 1), end_(states_) {}

private:
    const cuda::DeviceModel<Real>& device_model() const override { return runner_.model(); }
    cuda::Progress run(State<Real>& state, double time_step, int substeps, const Gait* gait,
                       const cuda::Trace<Real>& trace) override {
        const cuda::ModelView<Real>& view = runner_.model().view();
        State<Real> begin = state;
        if (gait && cuda::supports_both(this->model_))
            actuate(this->model_, *std::exchange(gait, nullptr), state.time, begin);
        states_.upload({begin});
        const auto row = [](double value) { return std::vector<double>{value}; };
        using Numbers = cuda::DeviceBuffer<double>;
        const Numbers frequency(row(gait ? gait->frequency : 0)), power(row(gait ? gait->power : 1)),
            amplitude(gait ? gait->amplitude : row(0)), phase(gait ? gait->phase : row(0)),
            offset(gait ? gait->offset : std::vector<double>{});
        cuda::BatchView<Real> batch = runner_.view_of(states_, 1);
        batch.start_time = state.time;
        batch.time_step = time_step;
        batch.substeps = substeps;
        if (gait)
            batch.gait = {frequency.data(), power.data(), amplitude.data(), phase.data(),
                          gait->offset.empty() ? nullptr : offset.data()};
        cuda::DeviceBuffer<Real> density(view.fluid);
        cuda::DeviceBuffer<int> neighbours(view.particles);
        batch.density = density.data();
        batch.neighbours = neighbours.data();
        batch.trace = trace;
        runner_.run(batch, {cuda::Progress{}});
        end_.fetch();
        state = end_.state(0, state);
        this->densities_ = density.download();
        this->neighbours_ = neighbours.download();
        return runner_.progress().front();
    }

    cuda::BatchRunner<Real> runner_;
    cuda::DeviceStates<Real> states_;
    typename cuda::DeviceStates<Real>::Copy end_;
};

template <class Real>
class GpuSolver<Real>::GridSolver : public Implementation {
public:
    GridSolver(const Model& model, const cuda::GridOptions& options)
        : Implementation(model), runner_(model, 1, options) {}

    std::vector<Real> pressures() const override {
        const std::vector<Real> of_fluid = h_ > 0 ? runner_.pressures(h_) : std::vector<Real>{};
        std::vector<Real> pressures(of_fluid.empty() ? 0 : this->model_.particles(), Real(0));
        for (std::size_t k = 0; k < of_fluid.size(); ++k) pressures[particle_of(k)] = of_fluid[k];
        return pressures;
    }
    std::vector<Vector3<Real>> forces() const override {
        if (!(time_ > 0) || !runner_.keeps_forces()) return {};
        std::vector<Vector3<Real>> forces(this->model_.particles(), Vector3<Real>::Zero());
        const std::vector<cuda::Vec4<Real>> impulses = runner_.impulses_on_solids();
        for (std::size_t k = 0; k < impulses.size(); ++k)
            forces[particle_of(runner_.model().view().fluid + k)] =
                Vector3<Real>(impulses[k].x, impulses[k].y, impulses[k].z) / time_;
        return forces;
    }

private:
    const cuda::DeviceModel<Real>& device_model() const override { return runner_.model(); }
    cuda::Progress run(State<Real>& state, double time_step, int substeps, const Gait* gait,
                       const cuda::Trace<Real>& trace) override {
        runner_.upload(0, state);
        const std::vector<const Gait*> gaits(gait ? 1 : 0, gait);
        const auto end = runner_.run({state.time, time_step, substeps, gaits, false}, nullptr, trace).front();
        state = runner_.download(0, state);
        if (gait)
            state.spring_rest_length =
                runner_.muscles(0).spring_rest_length;  // which the next frame's work begins with
        cuda::Progress progress;
        if (!end.finite) {
            progress.stopped = static_cast<int>(StopReason::unstable);
            progress.bad_particle = end.bad_particle;
            progress.bad_time = state.time + end.bad_substep * time_step / substeps;
            return progress;
        }
        if (gait && has_muscle_work(this->model_)) this->muscle_work_ += end.muscle_work;
        this->densities_ = runner_.densities();
        this->neighbours_ = runner_.neighbour_counts();
        time_ = static_cast<Real>(time_step);
        h_ = time_ / static_cast<Real>(substeps);
        return progress;
    }

    int particle_of(std::size_t number) const { return runner_.model().particle_of()[number]; }

    cuda::GridRunner<Real> runner_;
    Real time_ = 0, h_ = 0;  ///< of the last update and of its substeps, s; 0 before the first
};

template <class Real>
GpuSolver<Real>::GpuSolver(const Model& model, const GpuSolverOptions& options) {
    cuda::choose_device(options.device);
    check_model(model);
    if (model.water_box)
        throw InputError(
            "backend cuda: a GpuSolver has no scheme lattice; a Solver has its water on a GPU by Execution::gpu");
    if (const auto reason = cuda::refusal(model)) throw InputError("backend cuda: " + *reason);
    GpuPath path = options.path;
    if (path == GpuPath::by_size) {
        const bool blocks = model.scheme == Scheme::flex && model.companions.empty() && !cuda::supports_both(model);
        path = blocks ? GpuPath::block : GpuPath::whole_gpu;
    }
    if (path == GpuPath::block && model.scheme != Scheme::flex)
        throw InputError("backend cuda: scheme conserving by blocks; must be on the whole GPU");
    if (path == GpuPath::block && model.particles() > cuda::max_particles_of_a_block)
        throw InputError("backend cuda: " + std::to_string(model.particles()) +
                         " particles by blocks; must be at most " + std::to_string(cuda::max_particles_of_a_block));
    cuda::GridOptions grid{.keeps_forces = options.forces};
    if (path == GpuPath::whole_gpu_search) {
        grid.room = {0, 0};
        grid.lists = cuda::WaterLists::never;
    }
    if (path == GpuPath::block)
        implementation_ = std::make_unique<BlockSolver>(model);
    else
        implementation_ = std::make_unique<GridSolver>(model, grid);
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
double GpuSolver<Real>::muscle_work() const {
    return implementation_->muscle_work();
}
template <class Real>
void GpuSolver<Real>::clear_muscle_work() {
    implementation_->clear_muscle_work();
}
template <class Real>
std::string GpuSolver<Real>::save() const {
    return implementation_->save();
}
template <class Real>
void GpuSolver<Real>::restore(std::string_view saved) {
    implementation_->restore(saved);
}
template <class Real>
std::vector<Real> GpuSolver<Real>::densities() const {
    return implementation_->densities();
}

template <class Real>
std::vector<Real> GpuSolver<Real>::pressures() const {
    return implementation_->pressures();
}

template <class Real>
std::vector<Vector3<Real>> GpuSolver<Real>::forces() const {
    return implementation_->forces();
}

template <class Real>
std::vector<int> GpuSolver<Real>::neighbour_counts() const {
    return implementation_->neighbour_counts();
}

template class GpuSolver<float>;
template class GpuSolver<double>;

}  // namespace natator
