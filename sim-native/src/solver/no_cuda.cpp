// What a build without CUDA answers.
#include "natator/batch.h"
#include "natator/error.h"

namespace natator {

std::vector<Device> cuda_devices() {
    return {};
}

std::optional<std::string> gpu_refusal(const Scene&) {
    return "built without CUDA";
}

std::vector<Evaluation> evaluate_on_gpu(const Scene&, const std::vector<BatchMember>&, Precision, int) {
    throw NoDevice("backend cuda: this natator-sim was built without CUDA; must be built with -DNATATOR_CUDA=ON");
}

}  // namespace natator
