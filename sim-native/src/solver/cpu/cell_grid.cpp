#include "cell_grid.h"

#include <algorithm>
#include <cmath>

namespace natator::cpu {

template <class Real>
void CellGrid<Real>::cover(const std::array<Real, 3>& low, const std::array<Real, 3>& high, Real search_distance,
                           int max_cells) {
    // A little wider than L, so that rounding never puts a pair one cell further apart than its distance allows.
    const double wide = static_cast<double>(search_distance) * 1.0001;
    const std::array<double, 3> size{wide / reach_x, wide, wide};
    constexpr double many = 1e9;  // also for a box that is not finite
    std::array<double, 3> cells{};
    for (int axis = 0; axis < 3; ++axis)
        cells[axis] =
            std::min(many, std::max(1.0, std::floor((double(high[axis]) - double(low[axis])) / size[axis]) + 1));

    // Particles far from the rest must not cost memory: halve the longest axis until the box is small enough.
    while (cells[0] * cells[1] * cells[2] > max_cells) {
        double& longest = *std::max_element(cells.begin(), cells.end());
        longest = std::max(1.0, std::floor(longest / 2));
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double middle = (double(low[axis]) + double(high[axis])) / 2;
        count_[axis] = static_cast<int>(cells[axis]);
        low_[axis] = static_cast<Real>(middle - cells[axis] * size[axis] / 2);
        inverse_size_[axis] = static_cast<Real>(1 / size[axis]);
    }
}

template class CellGrid<float>;
template class CellGrid<double>;

}  // namespace natator::cpu
