#include <string>

#include "natator/batch.h"
#include "natator/model.h"
#include "solver/cuda/device.h"
#include "solver/cuda/owned_array.h"
#include "solver/cuda/refusal.h"

namespace natator {

std::vector<Device> cuda_devices() {
    const int count = cuda::device_count();
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

}  // namespace natator
