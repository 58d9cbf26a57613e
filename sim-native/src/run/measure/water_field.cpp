#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "model/water_volumes.h"
#include "natator/error.h"
#include "natator/measure.h"
#include "physics/dfsph.h"

namespace natator {
namespace {

constexpr double max_cells = 1e8;
constexpr double kernel_cells = 2;   // where the kernel ends
constexpr float min_weight = 1e-6f;  // sum of the kernels, below which there is no water

/// Cells along each axis and the grid's corner: from end to end of a periodic axis, else around all water.
WaterField grid_around(const Model& model, const Eigen::AlignedBox3d& water) {
    WaterField field;
    field.cell = model.parameters.fluid_rest_distance;
    for (int axis = 0; axis < 3; ++axis) {
        double low = water.min()[axis] - field.cell / 2, high = water.max()[axis] + field.cell / 2;
        for (const PeriodicAxis& periodic : model.periodic)
            if (periodic.axis == axis) low = periodic.low, high = periodic.high;
        const double count = std::max(1.0, std::round((high - low) / field.cell));
        field.cells[axis] = static_cast<int>(std::min(count, max_cells));
        field.corner[axis] = low;
    }
    if (const double all = field.cells.cast<double>().prod(); !(all <= max_cells)) {
        std::ostringstream text;
        text << "the water is spread over " << all << " cells: must be " << max_cells << " at most";
        throw InputError(text.str());
    }
    return field;
}

}  // namespace

template <class Real>
WaterField water_field(const Model& model, const State<Real>& state, const std::vector<Real>& pressures) {
    Eigen::AlignedBox3d box;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) box.extend(state.position[i].template cast<double>());
    if (box.isEmpty()) return {};
    WaterField field = grid_around(model, box);
    const auto size = field.cells.cast<std::size_t>().prod();
    field.velocity.assign(size, Eigen::Vector3f::Zero());
    field.density.assign(size, 0);
    const bool has_pressure = !pressures.empty();
    if (has_pressure) field.pressure.assign(size, 0);
    const double radius = kernel_cells * field.cell;
    const physics::WendlandKernel<double> kernel = physics::wendland_kernel(radius, wendland(0, radius));
    const double volume = std::pow(field.cell, 3);
    bool periodic[3] = {};
    for (const PeriodicAxis& axis : model.periodic) periodic[axis.axis] = true;

    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        // In cells, from the middle of the first.
        const Eigen::Vector3d at =
            (state.position[i].template cast<double>() - field.corner) / field.cell - Eigen::Vector3d::Constant(0.5);
        const Eigen::Vector3i low = (at.array() - kernel_cells).ceil().matrix().template cast<int>();
        const Eigen::Vector3i high = (at.array() + kernel_cells).floor().matrix().template cast<int>();
        for (int z = low.z(); z <= high.z(); ++z)
            for (int y = low.y(); y <= high.y(); ++y)
                for (int x = low.x(); x <= high.x(); ++x) {
                    const double distance = field.cell * (Eigen::Vector3d(x, y, z) - at).norm();
                    const auto weight = static_cast<float>(volume * kernel.value(distance));
                    int to[3] = {x, y, z};
                    bool inside = weight > 0;
                    for (int a = 0; a < 3; ++a) {
                        const int count = field.cells[a];
                        if (periodic[a]) to[a] = (to[a] % count + count) % count;
                        inside = inside && to[a] >= 0 && to[a] < count;
                    }
                    if (!inside) continue;
                    const std::size_t cell =
                        (static_cast<std::size_t>(to[2]) * field.cells[1] + to[1]) * field.cells[0] + to[0];
                    field.density[cell] += weight;
                    field.velocity[cell] += weight * state.velocity[i].template cast<float>();
                    if (has_pressure) field.pressure[cell] += weight * static_cast<float>(pressures[i]);
                }
    }
    for (std::size_t cell = 0; cell < size; ++cell) {
        const bool wet = field.density[cell] > min_weight;
        if (wet) field.velocity[cell] /= field.density[cell];
        if (has_pressure)
            field.pressure[cell] =
                wet ? field.pressure[cell] / field.density[cell] : std::numeric_limits<float>::quiet_NaN();
    }
    return field;
}

template WaterField water_field(const Model&, const State<float>&, const std::vector<float>&);
template WaterField water_field(const Model&, const State<double>&, const std::vector<double>&);

}  // namespace natator
