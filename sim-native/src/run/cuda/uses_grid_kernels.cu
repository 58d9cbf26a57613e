#include "uses_grid_kernels.h"

#include "natator/solver.h"
#include "solver/cuda/kernel_choice.h"
#include "solver/cuda/owned_array.h"

namespace natator::cuda {
namespace {

/// Contacts of a team have room for any that a scene could have.
bool has_room_by_blocks(const Model& model) {
    constexpr double max_bytes = 256 << 20;
    double fluid = 0;
    for (int i = 0; i < model.particles(); ++i) fluid += model.is_fluid(i);
    const double particles = model.particles(), solids = particles - fluid;
    return particles <= max_particles_of_a_block && 2 * solids * (particles + fluid) <= max_bytes;
}

}  // namespace

bool uses_grid_kernels(const Scene& scene, const Model& model, const BatchOptions& options) {
    if (options.whole_gpu || model.scheme != Scheme::flex || !scene.goals.empty() || !scene.companions.empty())
        return true;
    if (!supports_both(model)) return false;
    if (options.precision != Precision::single_precision || make_plan(model).effects()) return true;
    return !has_room_by_blocks(model) || device_attribute(cudaDevAttrCooperativeLaunch) == 0;
}

}  // namespace natator::cuda
