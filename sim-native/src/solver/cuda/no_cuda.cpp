// What a build without CUDA answers.
#include "no_cuda.h"
#include "natator/error.h"
#include "solver/cuda/grid/fetch_roof.h"
#include "solver/gpu_solver.h"

namespace natator {

void refuse_without_cuda() {
    throw NoDevice("backend cuda: natator was built without CUDA; must be built with -DNATATOR_CUDA=ON");
}

namespace cuda {

FetchRoof measure_fetch_roof(const Scene&, const std::vector<Gait>&, int, int) {
    refuse_without_cuda();
}
double measure_copy_bandwidth(int) {
    refuse_without_cuda();
}

}  // namespace cuda

struct SharedGpu::Pools {};
SharedGpu::SharedGpu() = default;
SharedGpu::~SharedGpu() = default;

template <class Real>
class GpuSolver<Real>::Implementation {};
template <class Real>
GpuSolver<Real>::GpuSolver(const Model&, const GpuSolverOptions&) {
    refuse_without_cuda();
}
template <class Real>
GpuSolver<Real>::~GpuSolver() = default;
template <class Real>
GpuSolver<Real>::GpuSolver(GpuSolver&&) noexcept = default;
template <class Real>
GpuSolver<Real>& GpuSolver<Real>::operator=(GpuSolver&&) noexcept = default;
template <class Real>
std::optional<Instability> GpuSolver<Real>::update(State<Real>&, double, int, StepObserver<Real>*) {
    refuse_without_cuda();
}
template <class Real>
std::optional<Instability> GpuSolver<Real>::frame(State<Real>&, const Gait&) {
    refuse_without_cuda();
}
template <class Real>
std::optional<Instability> GpuSolver<Real>::frame(State<Real>&, const Drive&) {
    refuse_without_cuda();
}
template <class Real>
std::vector<std::optional<Instability>> GpuSolver<Real>::frames(const std::vector<Frame>&) {
    refuse_without_cuda();
}
template <class Real>
const Model& GpuSolver<Real>::model() const {
    refuse_without_cuda();
}
template <class Real>
bool GpuSolver<Real>::shared() const {
    refuse_without_cuda();
}
template <class Real>
std::string GpuSolver<Real>::device() const {
    refuse_without_cuda();
}
template <class Real>
const std::vector<double>& GpuSolver<Real>::muscle_works() const {
    refuse_without_cuda();
}
template <class Real>
void GpuSolver<Real>::clear_muscle_work() {
    refuse_without_cuda();
}
template <class Real>
std::string GpuSolver<Real>::save() const {
    refuse_without_cuda();
}
template <class Real>
void GpuSolver<Real>::restore(std::string_view) {
    refuse_without_cuda();
}
template <class Real>
void GpuSolver<Real>::shift_water(const Eigen::Vector3d&) {
    refuse_without_cuda();
}
template <class Real>
double GpuSolver<Real>::cells_per_step() const {
    refuse_without_cuda();
}
template <class Real>
WaterField GpuSolver<Real>::lattice_water() const {
    refuse_without_cuda();
}
template <class Real>
std::vector<Real> GpuSolver<Real>::densities() const {
    refuse_without_cuda();
}
template <class Real>
std::vector<Real> GpuSolver<Real>::pressures() const {
    refuse_without_cuda();
}
template <class Real>
std::vector<Vector3<Real>> GpuSolver<Real>::forces() const {
    refuse_without_cuda();
}
template <class Real>
std::vector<int> GpuSolver<Real>::neighbour_counts() const {
    refuse_without_cuda();
}
template class GpuSolver<float>;
template class GpuSolver<double>;

}  // namespace natator
