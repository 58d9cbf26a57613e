#include <string>

#include "base/text.h"
#include "device.h"
#include "model_view.h"
#include "natator/error.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "owned_array.h"
#include "refusal.h"

namespace natator {
namespace cuda {

int device_count() {
    int count = 0;
    if (cudaGetDeviceCount(&count) == cudaSuccess) return count;
    cudaGetLastError();
    return 0;
}

std::string current_device_name() {
    int device = 0;
    check(cudaGetDevice(&device), "current device");
    cudaDeviceProp properties{};
    check(cudaGetDeviceProperties(&properties, device), "device properties");
    return properties.name + std::string(" ") + std::to_string(properties.multiProcessorCount);
}

void choose_device(int device) {
    const int devices = device_count();
    if (device < 0 || device >= devices)
        throw NoDevice("backend cuda: device " + std::to_string(device) + ": no such device; there " +
                       (devices == 1 ? "is 1 GPU" : "are " + std::to_string(devices) + " GPUs"));
    check(cudaSetDevice(device), "choose device");
}

std::optional<std::string> refusal(const Model& model) {
    if (model.particles() == 0) return "the scene has no particles; must have some";
    if (model.planes.size() > max_planes)
        return std::to_string(model.planes.size()) + " planes; must be at most " + std::to_string(max_planes);
    if (!make_plan(model).water) return std::nullopt;
    if (model.parameters.conserving.density_tolerance > 0) {
        return "densityTolerance = " + number_text(model.parameters.conserving.density_tolerance) +
               "; must be 0: a GPU has numIterations";
    }
    if (const std::size_t boundaries = model.planes.size() + 2 * model.periodic.size(); boundaries > max_boundaries)
        return std::to_string(boundaries) + (model.periodic.empty() ? " planes" : " planes and ends of periodic axes") +
               "; must be at most " + std::to_string(max_boundaries) + " in scheme conserving";
    if (model.particles() >= 1 << max_slot_bits)
        return std::to_string(model.particles()) + " particles; must be fewer than " +
               std::to_string(1 << max_slot_bits) + " in scheme conserving";
    return std::nullopt;
}

template <class Real>
Instability located(const Model& model, State<Real> before, const Drive& drive, double time_step, int substeps,
                    double frame_time, const Instability& found) {
    Solver<Real> solver(model);
    const double h = time_step / substeps, driven_at = model.scheme != Scheme::flex ? before.time + h : frame_time;
    if (drive) actuate(model, drive(driven_at), driven_at, before);
    const auto on_cpu = solver.update(before, h, 1);
    return on_cpu ? *on_cpu : found;
}

template Instability located(const Model&, State<float>, const Drive&, double, int, double, const Instability&);
template Instability located(const Model&, State<double>, const Drive&, double, int, double, const Instability&);

}  // namespace cuda

}  // namespace natator
