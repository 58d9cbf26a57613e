#include "perturb.h"

#include <random>
#include <string>

#include "natator/error.h"

namespace natator {

Perturbation choose_start(int start, Scene& scene) {
    if (start < 0) throw InputError("start = " + std::to_string(start) + ": must be a whole number in [0, 2147483647]");
    if (scene.scheme != Scheme::flex && scene.fluid) {
        scene.fluid->disorder = start;
        return {};
    }
    return {start_amplitude * scene.solver.fluid_rest_distance, static_cast<std::uint64_t>(start)};
}

void perturb(const Perturbation& perturbation, Model& model) {
    if (perturbation.amplitude == 0) return;
    std::mt19937_64 random(perturbation.seed);
    const bool plane = model.water_box && model.water_box->is_plane();
    for (Eigen::Vector3d& position : model.position) {
        for (int axis = 0; axis < 3; ++axis) {
            const double u = static_cast<double>(random() >> 11) * 0x1p-53;
            if (!(plane && axis == 1)) position[axis] += perturbation.amplitude * (2 * u - 1);
        }
    }
}

}  // namespace natator
