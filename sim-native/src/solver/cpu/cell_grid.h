#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

namespace natator::cpu {

/// A grid of cells over a box, for finding pairs closer than a search distance L. Cells measure L along y and z and
/// L/4 along x, and x runs fastest: the candidates of one row of cells are one run of slots, cut close to 2 L.
/// Positions outside the box belong to its border cells, so pairs stay at most `reach` cells apart there too.
template <class Real>
class CellGrid {
public:
    static constexpr int reach_x = 4;

    /// Lays the grid over [low, high]; a box of more than `max_cells` cells is cut down around its middle.
    void cover(const std::array<Real, 3>& low, const std::array<Real, 3>& high, Real search_distance, int max_cells);

    /// The grid in numbers: a value lies in cell (value - low) * inverse_size of each axis.
    struct Box {
        std::array<Real, 3> low, inverse_size;
        std::array<int, 3> count;
    };
    Box box() const { return {low_, inverse_size_, count_}; }

    int cells() const { return count_[0] * count_[1] * count_[2]; }

    int cell_x(Real x) const { return coordinate(x, 0); }
    int cell_y(Real y) const { return coordinate(y, 1); }
    int cell_z(Real z) const { return coordinate(z, 2); }
    int cell(Real x, Real y, Real z) const { return index(cell_x(x), cell_y(y), cell_z(z)); }

    /// The row of cells along x that a cell is in.
    int row(int cell) const { return cell / count_[0]; }

    /// The rows of cells that may hold particles within the search distance of those in one row.
    struct Rows {
        std::array<int, 9> first_cell;
        int count = 0;
    };
    Rows rows_around(int row) const {
        const int cz = row / count_[1], cy = row % count_[1];
        Rows rows;
        for (int iz = cz > 0 ? cz - 1 : 0; iz <= cz + 1 && iz < count_[2]; ++iz)
            for (int iy = cy > 0 ? cy - 1 : 0; iy <= cy + 1 && iy < count_[1]; ++iy)
                rows.first_cell[rows.count++] = index(0, iy, iz);
        return rows;
    }

    /// The cells [first, last] of such a row, along x, that may hold particles within the search distance of `cell`.
    struct Range {
        int first, last;
    };
    Range range_around(int cell) const {
        const int cx = cell % count_[0];
        return {std::max(cx - reach_x, 0), std::min(cx + reach_x, count_[0] - 1)};
    }

private:
    int index(int cx, int cy, int cz) const { return (cz * count_[1] + cy) * count_[0] + cx; }

    int coordinate(Real value, int axis) const {
        const Real cells_from_low = (value - low_[axis]) * inverse_size_[axis];
        if (!(cells_from_low > 0)) return 0;  // also for NaN
        const Real last = static_cast<Real>(count_[axis] - 1);
        return cells_from_low < last ? static_cast<int>(cells_from_low) : count_[axis] - 1;
    }

    std::array<Real, 3> low_{};
    std::array<Real, 3> inverse_size_{};
    std::array<int, 3> count_{1, 1, 1};
};

}  // namespace natator::cpu
