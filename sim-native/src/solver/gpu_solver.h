#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"
#include "natator/solver.h"

namespace natator {

/// How a State is computed on a GPU. Below 20 000 particles `block` and `whole_gpu` differ in the last digits.
enum class GpuPath {
    /// blocks for up to 20 000 particles in scheme `flex`, else the whole GPU; the bits are those of evaluate_on_gpu
    by_size,
    block,             ///< blocks of threads, as a member of a batch; scheme `flex`, at most 65535 particles
    whole_gpu,         ///< kernels of the whole GPU
    whole_gpu_search,  ///< kernels of the whole GPU that store no lists, but search neighbours in every pass
};

/// Where and how a GpuSolver computes.
struct GpuSolverOptions {
    int device = 0;  ///< number of the GPU, see cuda_devices in batch.h
    GpuPath path = GpuPath::by_size;
    bool forces = false;          ///< keeps what GpuSolver::forces gives; not in scheme flex
    SharedGpu* shared = nullptr;  ///< as Execution::shared; then by the whole GPU
};

/// A Solver on a GPU, with a choice of paths for tests and benchmarks. Results agree with the CPU's to rounding; the
/// same GPU and input give the same bits. A library built without CUDA has this class too; making one then throws
/// NoDevice.
template <class Real>
class GpuSolver {
public:
    /// Keeps a reference to `model`, which must live, unchanged, as long as this; a temporary one is refused by the
    /// compiler. Throws NoDevice ("built without CUDA", or no such GPU), InputError when the Model's lists do not
    /// belong together (as Solver does), or it needs what the GPU's stages do not do or is too large for
    /// `options.path`.
    explicit GpuSolver(const Model& model, const GpuSolverOptions& options = {});
    explicit GpuSolver(const Model&& model, const GpuSolverOptions& options = {}) = delete;
    ~GpuSolver();
    GpuSolver(GpuSolver&&) noexcept;
    GpuSolver& operator=(GpuSolver&&) noexcept;

    /// Advances `state` by `time_step` (s) in `substeps` equal substeps, with the rest lengths it holds. Returns where
    /// the state stopped being finite; `state` then keeps its values from before that substep. Throws as Solver's. The
    /// observer is told after the last substep what it would have seen in all of them; what is kept for it takes device
    /// memory.
    std::optional<Instability> update(State<Real>& state, double time_step, int substeps,
                                      StepObserver<Real>* observer = nullptr);

    /// One frame of the model: as an update by the model's time step and substeps, with the muscles driven by `gait`,
    /// which must fit the model (check_gait): throws InputError if it has not one value for each actuator.
    std::optional<Instability> frame(State<Real>& state, const Gait& gait);
    /// Likewise with muscles that `drive` drives, as Solver's.
    std::optional<Instability> frame(State<Real>& state, const Drive& drive);

    /// A frame of one of several solvers, whose muscles `drive` drives.
    struct Frame {
        GpuSolver* solver;
        State<Real>* state;
        const Drive* drive;
    };
    /// Frames of solvers that share a GPU (GpuSolverOptions::shared), those of equal Models by the same kernels. What
    /// became unstable is told by frame, with the bits that each has alone. Throws as `frame`.
    static std::vector<std::optional<Instability>> frames(const std::vector<Frame>& all);

    const Model& model() const;  ///< that it was made with
    bool shared() const;         ///< whether with GpuSolverOptions::shared
    /// What settles a Model alike, as a cache of starts knows it: the GPU's name and the path.
    std::string device() const;

    /// Work that the muscles of each swimmer did in all frames so far by their changes of rest length, mass
    /// length^2/s^2 (Solver::muscle_works); 0 in scheme flex.
    const std::vector<double>& muscle_works() const;
    double muscle_work() const {  ///< that of all
        double sum = 0;
        for (const double work : muscle_works()) sum += work;
        return sum;
    }
    void clear_muscle_work();
    /// As Solver's.
    std::string save() const;
    void restore(std::string_view saved);
    void shift_water(const Eigen::Vector3d& by);
    double cells_per_step() const;
    WaterField lattice_water() const;

    /// Density of each particle in units of rest density: in scheme flex at the last update's final positions, in
    /// conserving at those of the start of its last substep. 0 for solids, and for all before the first update.
    std::vector<Real> densities() const;
    /// Pressure of each fluid particle in the last substep, mass/(length s^2) (Solver::pressures). Empty before the
    /// first update, without water, in scheme flex, and where the GPU is shared; there forces are, too, but in scheme
    /// lattice, and neighbours are not counted.
    std::vector<Real> pressures() const;
    /// Mean force of the water on each particle over the last update, mass length/s^2 (Solver::forces). Empty without
    /// GpuSolverOptions::forces, and before the first update, when they are 0 in scheme lattice.
    std::vector<Vector3<Real>> forces() const;
    /// Number of fluid and contact neighbours of each particle in the last substep; 0 before the first.
    std::vector<int> neighbour_counts() const;

private:
    class Implementation;
    class BlockSolver;
    class GridSolver;
    std::unique_ptr<Implementation> implementation_;
};

extern template class GpuSolver<float>;
extern template class GpuSolver<double>;

}  // namespace natator
