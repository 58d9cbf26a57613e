#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "natator/solver.h"

namespace natator {

/// How a State is computed.
enum class GpuPath {
    by_size,           ///< as evaluate_on_gpu does
    block,             ///< by one block, as in a batch; at most 65535 particles
    whole_gpu,         ///< by the whole GPU
    whole_gpu_search,  ///< the same with contacts searched anew in each iteration, as where lists overflow
};

/// Advances one State of a Model on a GPU, update by update, as Solver does on the CPU: for observing and testing what
/// batches compute. The State travels to the device and back with every update.
template <class Real>
class GpuSolver {
public:
    /// Throws NoDevice without that GPU, InputError when the Model needs what the GPU's stages do not do.
    explicit GpuSolver(const Model& model, int device = 0, GpuPath path = GpuPath::by_size);
    ~GpuSolver();
    GpuSolver(GpuSolver&&) noexcept;
    GpuSolver& operator=(GpuSolver&&) noexcept;

    /// As Solver's. `state` keeps its values from before the substep that was not finite.
    std::optional<Instability> update(State<Real>& state, double time_step, int substeps,
                                      StepObserver<Real>* observer = nullptr);
    std::optional<Instability> frame(State<Real>& state, const Gait& gait);
    std::vector<Real> densities() const;
    std::vector<int> neighbour_counts() const;

private:
    class Implementation;
    class ByBlock;
    class ByWholeGpu;
    std::unique_ptr<Implementation> implementation_;
};

extern template class GpuSolver<float>;
extern template class GpuSolver<double>;

}  // namespace natator
