// What a build without CUDA answers.
#include "solver/cuda/no_cuda.h"

#include "natator/batch.h"
#include "uses_grid_kernels.h"

namespace natator {

std::vector<Device> cuda_devices() {
    return {};
}

std::optional<std::string> gpu_refusal(const Scene&) {
    return "built without CUDA";
}

std::vector<Evaluation> evaluate_on_gpu(const Scene&, const std::vector<BatchMember>&, const BatchOptions&) {
    refuse_without_cuda();
}

namespace cuda {

bool uses_grid_kernels(const Scene&, const Model&, const BatchOptions&) {
    refuse_without_cuda();
}

}  // namespace cuda
}  // namespace natator
