#include "disorder_fluid.h"

#include <random>

namespace natator {

void disorder_fluid(double spacing, Model& model, int seed) {
    constexpr double most = 0.2;  // of the spacing
    std::mt19937 random(seed);    // the same everywhere, unlike the distributions of the library
    const auto number = [&random] { return 2 * static_cast<double>(random()) / 4294967295.0 - 1; };
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        for (int axis = 0; axis < 3; ++axis) model.position[i][axis] += most * spacing * number();
    }
}

}  // namespace natator
