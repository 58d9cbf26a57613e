#pragma once

#include "../substep.h"

namespace natator::cpu {

template <class Real>
template <class Visit>
void Substep<Real>::for_each_fluid_neighbour(int slot, const Visit& visit) const {
    const int block = slot / lanes;
    const Vec3<Real> x = position_of_slot(slot);
    for (int row = ws_.row_begin[block]; row < ws_.row_begin[block + 1]; ++row) {
        const int other = ws_.neighbour[static_cast<std::size_t>(row) * lanes + slot % lanes];
        if (other == ws_.slots) return;  // the rest of the column is unused
        const Vec3<Real> difference = x - position_of_slot(other);
        const Real r = norm(difference);
        if (r > 0 && r < constants_.radius) visit(other, difference, r, r * constants_.inverse_radius);
    }
}

}  // namespace natator::cpu
