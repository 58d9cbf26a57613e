#include "gpu_solver.h"

#include <map>
#include <mutex>
#include <span>
#include <tuple>
#include <utility>

#include "base/byte_reader.h"
#include "base/byte_writer.h"
#include "base/side_by_side.h"
#include "cuda/device.h"
#include "cuda/grid/grid_pool.h"
#include "cuda/grid/parts.h"
#include "cuda/kernel_choice.h"
#include "cuda/refusal.h"
#include "flex/cuda/batch_runner.h"
#include "lattice/gpu_swim.h"
#include "law_name.h"
#include "model/check_gait.h"
#include "model/check_model.h"
#include "model/model_key.h"
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
    /// What moves the muscles in an update; empty leaves them as they are.
    struct Muscles {
        Drive drive;
        const Gait* gait = nullptr;  ///< which `drive` is that of, if it is one
    };

    explicit Implementation(const Model& model) : model_(model) {}
    virtual ~Implementation() = default;

    std::optional<Instability> update(State<Real>& state, double time_step, int substeps, StepObserver<Real>* observer,
                                      const Muscles& muscles) {
        check_state(model_, state);
        check_step(time_step, substeps);
        std::optional<cuda::TraceBuffers<Real>> trace;
        if (observer) trace.emplace(device_model().view(), substeps);
        const cuda::Progress progress =
            run(state, time_step, substeps, muscles, trace ? trace->view() : cuda::Trace<Real>{});
        const std::optional<Instability> found = end(state, time_step, substeps, muscles.drive, progress);
        if (observer && !found) trace->report_to(device_model(), *observer);
        return found;
    }

    std::vector<Real> densities() const {
        std::vector<Real> densities(model_.particles(), Real(0));
        for (std::size_t k = 0; k < densities_.size(); ++k) {
            const int i = device_model().particle_of()[k];
            if (model_.inverse_mass[i] > 0) densities[i] = densities_[k];
        }
        return densities;
    }

    const std::vector<double>& muscle_works() const { return muscle_work_; }
    void clear_muscle_work() { std::fill(muscle_work_.begin(), muscle_work_.end(), 0); }
    std::string save() const {
        ByteWriter saved;
        for (const double work : muscle_work_) saved.add(work);
        save_water(saved);
        return saved.take();
    }
    void restore(std::string_view saved) {
        ByteReader from(saved);
        std::vector<double> work(muscle_work_.size());
        for (double& of_swimmer : work) from.read(of_swimmer);
        restore_water(from);
        muscle_work_ = std::move(work);
    }

    std::vector<int> neighbour_counts() const {
        std::vector<int> counts(model_.particles(), 0);
        for (std::size_t k = 0; k < neighbours_.size(); ++k) counts[device_model().particle_of()[k]] = neighbours_[k];
        return counts;
    }

    virtual void shift_water(const Eigen::Vector3d&) {}
    virtual double cells_per_step() const { return 0; }
    virtual WaterField lattice_water() const { return {}; }
    virtual std::vector<Real> pressures() const { return {}; }
    virtual std::vector<Vector3<Real>> forces() const { return {}; }

    const Model& model() const { return model_; }
    /// What this GPU makes of a Model, as a cache of starts knows it.
    virtual std::string device() const = 0;
    virtual bool shared() const { return false; }

protected:
    virtual void save_water(ByteWriter&) const {}
    virtual void restore_water(const ByteReader& from) { from.require_end(); }
    virtual const cuda::DeviceModel<Real>& device_model() const = 0;
    /// One update of `state`, and of what is kept of it by device number; its time stays.
    virtual cuda::Progress run(State<Real>& state, double time_step, int substeps, const Muscles& muscles,
                               const cuda::Trace<Real>& trace) = 0;

    /// Sets the time of a State after an update, or says where it stopped being finite.
    std::optional<Instability> end(State<Real>& state, double time_step, int substeps, const Drive& drive,
                                   const cuda::Progress& progress) const {
        const double start = state.time;
        if (progress.stopped < 0) {
            state.time = start + time_step;
            return std::nullopt;
        }
        state.time = progress.bad_time;
        const int bad =
            progress.bad_particle < model_.particles() ? device_model().particle_of()[progress.bad_particle] : 0;
        if (progress.broken != physics::Law::finite)
            return Instability{bad, "frame", state.time, name(progress.broken)};
        if (model_.water_box && !(model_.inverse_mass[bad] > 0))  // an obstacle, which is no body that the CPU solves
            return Instability{bad, "collision and streaming", state.time};
        const Instability found{bad, "velocities", state.time};
        if (!model_.water_box) return cuda::located(model_, state, drive, time_step, substeps, start, found);
        Model bodies = model_;  // the CPU would have to make all water anew
        bodies.water_box.reset();
        return cuda::located(bodies, state, drive, time_step, substeps, start, found);
    }

    const Model& model_;
    std::vector<Real> densities_;
    std::vector<int> neighbours_;
    /// of frames, by swimmer; scheme `flex` has none
    std::vector<double> muscle_work_ = std::vector<double>(model_.swimmers());
};

template <class Real>
class GpuSolver<Real>::BlockSolver : public Implementation {
public:
    explicit BlockSolver(const Model& model)
        : Implementation(model), runner_(model), states_(runner_.model(), 1), end_(states_) {}

private:
    const cuda::DeviceModel<Real>& device_model() const override { return runner_.model(); }
    using Muscles = typename Implementation::Muscles;
    std::string device() const override { return cuda::current_device_name() + " block "; }
    cuda::Progress run(State<Real>& state, double time_step, int substeps, const Muscles& muscles,
                       const cuda::Trace<Real>& trace) override {
        const cuda::ModelView<Real>& view = runner_.model().view();
        State<Real> begin = state;
        const Gait* const gait = cuda::supports_both(this->model_) ? nullptr : muscles.gait;
        if (muscles.drive && !gait) actuate(this->model_, muscles.drive(state.time), state.time, begin);
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
    /// With a runner of its own, or each time with one of the pool, which others use in between.
    GridSolver(const Model& model, std::shared_ptr<cuda::GridPool<Real>> pool, const GpuSolverOptions& options)
        : Implementation(model), pool_(std::move(pool)) {
        if (!options.shared) own_.emplace(pool_->lend(1));
        if (model.water_box) swim_.emplace(model, options.device, options.forces);
    }

    void shift_water(const Eigen::Vector3d& by) override {
        if (swim_) swim_->shift(by);
    }
    double cells_per_step() const override { return swim_ ? swim_->fastest() : 0; }
    WaterField lattice_water() const override { return swim_ ? swim_->field() : WaterField{}; }

    std::vector<Real> pressures() const override {
        const std::vector<Real> of_fluid = own_ && h_ > 0 ? (*own_)->pressures(h_) : std::vector<Real>{};
        std::vector<Real> pressures(of_fluid.empty() ? 0 : this->model_.particles(), Real(0));
        for (std::size_t k = 0; k < of_fluid.size(); ++k) pressures[particle_of(k)] = of_fluid[k];
        return pressures;
    }
    std::vector<Vector3<Real>> forces() const override {
        if (swim_) return swim_->template forces<Real>();
        if (!(time_ > 0) || !own_ || !(*own_)->keeps_forces()) return {};
        std::vector<Vector3<Real>> forces(this->model_.particles(), Vector3<Real>::Zero());
        const std::vector<cuda::Vec4<Real>> impulses = (*own_)->impulses_on_solids();
        for (std::size_t k = 0; k < impulses.size(); ++k)
            forces[particle_of(device_model().view().fluid + k)] =
                Vector3<Real>(impulses[k].x, impulses[k].y, impulses[k].z) / time_;
        return forces;
    }
    std::string device() const override {
        pool_->choose();
        return cuda::current_device_name() + " grid ";
    }
    bool shared() const override { return !own_; }

    cuda::GridPool<Real>* pool() const { return pool_.get(); }
    /// A frame of each of some that have this pool, in these turns if there are any.
    static std::vector<std::optional<Instability>> frames(cuda::GridPool<Real>& pool, std::span<const Frame> frames,
                                                          cuda::TurnsOfGpu* turns) {
        std::vector<GridSolver*> solvers;
        std::vector<State<Real>*> states;
        std::vector<Drive> drives;
        for (const Frame& frame : frames) {
            solvers.push_back(static_cast<GridSolver*>(frame.solver->implementation_.get()));
            states.push_back(frame.state);
            drives.push_back(*frame.drive);
        }
        const Model& model = pool.host_model();
        const double time_step = model.time_step;
        const int substeps = model.parameters.substeps;
        const auto runner = pool.lend(static_cast<int>(frames.size()));
        const std::vector<cuda::Progress> progress =
            run(*runner, solvers, states, time_step, substeps, drives, {}, turns);
        std::vector<std::optional<Instability>> found(frames.size());
        for (std::size_t k = 0; k < frames.size(); ++k)
            found[k] = solvers[k]->end(*states[k], time_step, substeps, drives[k], progress[k]);
        return found;
    }

private:
    using Muscles = typename Implementation::Muscles;
    void save_water(ByteWriter& saved) const override {
        if (swim_) swim_->save(saved);
    }
    void restore_water(const ByteReader& from) override {
        if (swim_)
            swim_->restore(from);
        else
            from.require_end();
    }
    const cuda::DeviceModel<Real>& device_model() const override { return pool_->model(); }
    cuda::Progress run(State<Real>& state, double time_step, int substeps, const Muscles& muscles,
                       const cuda::Trace<Real>& trace) override {
        std::optional<typename cuda::GridPool<Real>::Loan> lent;
        if (!own_) lent.emplace(pool_->lend(1));
        const std::vector<Drive> drives(muscles.drive ? 1 : 0, muscles.drive);
        return run(own_ ? **own_ : **lent, {this}, {&state}, time_step, substeps, drives, trace).front();
    }

    /// An update of the States, which are the first of the runner, and of what their solvers keep.
    static std::vector<cuda::Progress> run(cuda::GridRunner<Real>& runner, const std::vector<GridSolver*>& solvers,
                                           const std::vector<State<Real>*>& states, double time_step, int substeps,
                                           const std::vector<Drive>& drives, const cuda::Trace<Real>& trace,
                                           cuda::TurnsOfGpu* turns = nullptr) {
        const bool in_lattice = solvers.front()->swim_.has_value();
        const auto h = static_cast<double>(static_cast<Real>(time_step) / static_cast<Real>(substeps));
        for (int k = 0; in_lattice && k < runner.states(); ++k)
            runner.set_water(
                k, k < static_cast<int>(states.size()) ? solvers[k]->swim_->begin(states[k]->time, h) : nullptr);
        typename cuda::GridRunner<Real>::Update update{
            .time_step = time_step, .substeps = substeps, .from{states.begin(), states.end()}, .turns = turns};
        for (std::size_t k = 0; k < drives.size(); ++k) update.muscles.push_back({drives[k], states[k]->time});
        update.muscles.resize(drives.empty() ? 0 : runner.states());
        const auto ends = runner.run(update, nullptr, trace);
        runner.download_all(states);
        const std::vector<Real> densities = runner.densities();
        const std::vector<int> neighbours = solvers.front()->own_ ? runner.neighbour_counts() : std::vector<int>{};
        std::vector<cuda::Progress> progress(states.size());
        for (std::size_t k = 0; k < states.size(); ++k) {
            const int made = ends[k].finite                         ? substeps
                             : ends[k].fault == cuda::fault_of_body ? ends[k].bad_substep
                                                                    : ends[k].bad_substep + 1;
            const double time = states[k]->time + made * time_step / substeps;
            if (in_lattice) solvers[k]->swim_->end(time, h);
            if (ends[k].finite) {
                solvers[k]->keep(k, time_step, substeps, densities, neighbours);
                if (!drives.empty() && has_muscle_work(solvers[k]->model_))
                    for (std::size_t i = 0; i < ends[k].muscle_work.size(); ++i)
                        solvers[k]->muscle_work_[i] += ends[k].muscle_work[i];
                continue;
            }
            progress[k].stopped = static_cast<int>(StopReason::unstable);
            progress[k].bad_particle = ends[k].bad_particle;
            progress[k].bad_time = time;
            if (ends[k].fault == cuda::fault_mach) progress[k].broken = physics::Law::mach;
        }
        return progress;
    }

    /// Of the runner's State k.
    void keep(std::size_t k, double time_step, int substeps, const std::vector<Real>& densities,
              const std::vector<int>& neighbours) {
        const auto part = [k](const auto& of_all, std::size_t size, auto& to) {
            if (!of_all.empty()) to.assign(of_all.begin() + k * size, of_all.begin() + (k + 1) * size);
        };
        part(densities, device_model().view().fluid, this->densities_);
        part(neighbours, device_model().view().particles, this->neighbours_);
        time_ = static_cast<Real>(time_step);
        h_ = time_ / static_cast<Real>(substeps);
    }

    int particle_of(std::size_t number) const { return device_model().particle_of()[number]; }

    std::shared_ptr<cuda::GridPool<Real>> pool_;
    std::optional<typename cuda::GridPool<Real>::Loan> own_;
    std::optional<lattice::GpuSwim> swim_;  ///< of scheme lattice
    Real time_ = 0, h_ = 0;                 ///< of the last update and of its substeps, s; 0 before the first
};

/// By Model, as long as a solver has one.
struct SharedGpu::Pools {
    template <class Real>
    using ByModel = std::map<std::string, std::weak_ptr<cuda::GridPool<Real>>>;

    /// That of a Model, whoever asks for it.
    template <class Real>
    std::shared_ptr<cuda::GridPool<Real>> of(const Model& model, int device) {
        const std::string key = std::to_string(device) + ' ' + model_key(model);
        const std::lock_guard lock(mutex);
        ByModel<Real>& known = std::get<ByModel<Real>>(pools);
        if (std::shared_ptr<cuda::GridPool<Real>> pool = known[key].lock()) return pool;
        auto pool = std::make_shared<cuda::GridPool<Real>>(model, cuda::GridOptions{}, device);
        known[key] = pool;
        std::erase_if(known, [](const auto& one) { return one.second.expired(); });
        return pool;
    }

    std::mutex mutex;
    std::tuple<ByModel<float>, ByModel<double>> pools;
};

SharedGpu::SharedGpu() : pools_(std::make_unique<Pools>()) {}
SharedGpu::~SharedGpu() = default;

template <class Real>
GpuSolver<Real>::GpuSolver(const Model& model, const GpuSolverOptions& options) {
    cuda::choose_device(options.device);
    check_model(model);
    if (const auto reason = cuda::refusal(model)) throw InputError("backend cuda: " + *reason);
    GpuPath path = options.shared ? GpuPath::whole_gpu : options.path;
    if (path == GpuPath::by_size) {
        const bool blocks = model.scheme == Scheme::flex && model.companions.empty() && !cuda::supports_both(model);
        path = blocks ? GpuPath::block : GpuPath::whole_gpu;
    }
    if (path == GpuPath::block && model.scheme != Scheme::flex)
        throw InputError("backend cuda: schemes conserving and lattice by blocks; must be on the whole GPU");
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
    else if (options.shared)
        implementation_ =
            std::make_unique<GridSolver>(model, options.shared->pools().of<Real>(model, options.device), options);
    else
        implementation_ = std::make_unique<GridSolver>(
            model, std::make_shared<cuda::GridPool<Real>>(model, grid, options.device), options);
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
    return implementation_->update(state, time_step, substeps, observer, {});
}

template <class Real>
std::optional<Instability> GpuSolver<Real>::frame(State<Real>& state, const Gait& gait) {
    const Model& model = implementation_->model();
    check_lengths(gait, model.actuators);
    return implementation_->update(state, model.time_step, model.parameters.substeps, nullptr,
                                   {[&](double time) { return drive(model, gait, time); }, &gait});
}

template <class Real>
std::optional<Instability> GpuSolver<Real>::frame(State<Real>& state, const Drive& drive) {
    const Model& model = implementation_->model();
    return implementation_->update(state, model.time_step, model.parameters.substeps, nullptr, {drive});
}

template <class Real>
std::vector<std::optional<Instability>> GpuSolver<Real>::frames(const std::vector<Frame>& all) {
    constexpr int max_streams = 3, particles_at_a_time = 2'000'000;  // as evaluate_on_gpu
    using Pool = cuda::GridPool<Real>;
    std::map<Pool*, std::vector<std::size_t>> by_pool;
    for (std::size_t k = 0; k < all.size(); ++k) {
        check_state(all[k].solver->implementation_->model(), *all[k].state);
        by_pool[static_cast<GridSolver&>(*all[k].solver->implementation_).pool()].push_back(k);
    }
    struct Part {
        Pool* pool;
        cuda::TurnsOfGpu* turns;
        std::vector<std::size_t> numbers;
    };
    std::vector<Part> parts;
    for (const auto& [pool, numbers] : by_pool) {
        const Model& model = pool->host_model();
        const int most = particles_at_a_time / max_streams / model.particles() + 1;
        const auto count = static_cast<double>(numbers.size());
        bool full = count * model.particles() > 2e5;  // of a GPU, which others' kernels then delay
        int streams = full ? cuda::TurnsOfGpu::at_a_time : max_streams;
        if (model.water_box) {
            const double cells = count * model.water_box->cells.cast<double>().prod();
            full = cells > 1e6;
            streams = cells > 8e6 ? cuda::TurnsOfGpu::at_a_time : 1;
        }
        const cuda::Parts own(static_cast<int>(numbers.size()), most, streams);
        for (int part = 0; part < own.count; ++part) {
            const auto first = numbers.begin() + own.first(part);
            parts.push_back({pool, full ? &pool->turns() : nullptr, {first, first + own.size_of(part)}});
        }
    }
    std::vector<std::optional<Instability>> found(all.size());
    // Models that few have fill no GPU: then as many at a time as there are processors.
    const std::size_t at_once = by_pool.size() > max_streams ? SIZE_MAX : max_streams;
    side_by_side(
        parts.size(),
        [&](std::size_t part) {
            const auto& [pool, turns, numbers] = parts[part];
            std::vector<Frame> own;
            for (const std::size_t k : numbers) own.push_back(all[k]);
            const auto ends = GridSolver::frames(*pool, own, turns);
            for (std::size_t i = 0; i < numbers.size(); ++i) found[numbers[i]] = ends[i];
        },
        at_once);
    return found;
}

template <class Real>
const Model& GpuSolver<Real>::model() const {
    return implementation_->model();
}
template <class Real>
bool GpuSolver<Real>::shared() const {
    return implementation_->shared();
}
template <class Real>
std::string GpuSolver<Real>::device() const {
    return implementation_->device();
}

template <class Real>
const std::vector<double>& GpuSolver<Real>::muscle_works() const {
    return implementation_->muscle_works();
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
void GpuSolver<Real>::shift_water(const Eigen::Vector3d& by) {
    implementation_->shift_water(by);
}
template <class Real>
double GpuSolver<Real>::cells_per_step() const {
    return implementation_->cells_per_step();
}
template <class Real>
WaterField GpuSolver<Real>::lattice_water() const {
    return implementation_->lattice_water();
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
