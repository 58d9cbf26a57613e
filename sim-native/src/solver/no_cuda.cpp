// What a build without CUDA answers.
#include "natator/batch.h"
#include "natator/error.h"
#include "natator/gpu_solver.h"
#include "solver/cuda/large/fetch_roof.h"
#include "solver/cuda/way.h"
#include "solver/lattice/water.h"

namespace natator {
namespace {

[[noreturn]] void refuse() {
    throw NoDevice("backend cuda: natator was built without CUDA; must be built with -DNATATOR_CUDA=ON");
}

}  // namespace

std::vector<Device> cuda_devices() {
    return {};
}

std::optional<std::string> gpu_refusal(const Scene&) {
    return "built without CUDA";
}

std::vector<Evaluation> evaluate_on_gpu(const Scene&, const std::vector<BatchMember>&, const BatchOptions&) {
    refuse();
}

namespace cuda {

FetchRoof measure_fetch_roof(const Scene&, const std::vector<Gait>&, int, int) {
    refuse();
}
double measure_copy_bandwidth(int) {
    refuse();
}
bool by_whole_gpu(const Scene&, const Model&, const BatchOptions&) {
    refuse();
}

}  // namespace cuda

std::unique_ptr<lattice::Water> lattice::Water::on_gpu(const Box&, int) {
    refuse();
}

template <class Real>
class GpuSolver<Real>::Implementation {};
template <class Real>
GpuSolver<Real>::GpuSolver(const Model&, const GpuSolverOptions&) {
    refuse();
}
template <class Real>
GpuSolver<Real>::~GpuSolver() = default;
template <class Real>
GpuSolver<Real>::GpuSolver(GpuSolver&&) noexcept = default;
template <class Real>
GpuSolver<Real>& GpuSolver<Real>::operator=(GpuSolver&&) noexcept = default;
template <class Real>
std::optional<Instability> GpuSolver<Real>::update(State<Real>&, double, int, StepObserver<Real>*) {
    refuse();
}
template <class Real>
std::optional<Instability> GpuSolver<Real>::frame(State<Real>&, const Gait&) {
    refuse();
}
template <class Real>
double GpuSolver<Real>::muscle_work() const {
    refuse();
}
template <class Real>
std::vector<Real> GpuSolver<Real>::densities() const {
    refuse();
}
template <class Real>
std::vector<Real> GpuSolver<Real>::pressures() const {
    refuse();
}
template <class Real>
std::vector<Vector3<Real>> GpuSolver<Real>::forces() const {
    refuse();
}
template <class Real>
std::vector<int> GpuSolver<Real>::neighbour_counts() const {
    refuse();
}
template class GpuSolver<float>;
template class GpuSolver<double>;

}  // namespace natator
