#include "perturb.h"

#include <random>

namespace natator {

void perturb(const Perturbation& perturbation, Model& model) {
    if (perturbation.amplitude == 0) return;
    std::mt19937_64 random(perturbation.seed);
    for (Eigen::Vector3d& position : model.position) {
        for (double& coordinate : position) {
            const double u = static_cast<double>(random() >> 11) * 0x1p-53;
            coordinate += perturbation.amplitude * (2 * u - 1);
        }
    }
}

}  // namespace natator
