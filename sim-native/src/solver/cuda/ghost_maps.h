#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "model_view.h"
#include "physics/border.h"

namespace natator::cuda {

/// `border` behind `first`.
template <class Real>
GhostMap<Real> through(const GhostMap<Real>& first, const physics::Border<Real>& border) {
    const Vec3<Real>& n = border.surface.normal;
    const Real component[3] = {n.x, n.y, n.z};
    GhostMap<Real> both = first;
    if (border.shift > 0) {
        for (int k = 0; k < 3; ++k) both.row[k].w += border.shift * component[k];
        return both;
    }
    Vec4<Real> along{0, 0, 0, border.surface.offset};
    for (int k = 0; k < 3; ++k) {
        const Vec4<Real>& row = first.row[k];
        const Real part = component[k];
        along = {along.x + part * row.x, along.y + part * row.y, along.z + part * row.z, along.w + part * row.w};
    }
    for (int k = 0; k < 3; ++k) {
        Vec4<Real>& row = both.row[k];
        const Real twice = 2 * component[k];
        row = {row.x - twice * along.x, row.y - twice * along.y, row.z - twice * along.z, row.w - twice * along.w};
    }
    return both;
}

/// What takes a particle to its ghost beyond each set of `borders`: entry k is of those whose bits are set in k, passed in their order.
template <class Real>
std::vector<GhostMap<Real>> ghost_maps(const std::vector<physics::Border<Real>>& borders) {
    std::vector<GhostMap<Real>> maps(std::size_t(1) << borders.size());
    maps[0] = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    for (std::size_t set = 1; set < maps.size(); ++set) {
        const int last = std::bit_width(set) - 1;
        maps[set] = through(maps[set ^ std::size_t(1) << last], borders[last]);
    }
    return maps;
}

/// So many copies a particle may have, itself among them: each border within `reach` doubles them, but one that faces another does so only if
/// a particle may be near both.
template <class Real>
int max_copies(const std::vector<physics::Border<Real>>& borders, Real reach) {
    int copies = 1;
    for (std::size_t k = 0; k < borders.size(); ++k) {
        const physics::PlaneSurface<Real>& plane = borders[k].surface;
        bool faces = false;
        for (std::size_t e = 0; e < k; ++e) {
            const physics::PlaneSurface<Real>& other = borders[e].surface;
            if (!(dot(other.normal, plane.normal) < 0)) continue;
            faces = true;
            if (plane.offset + other.offset < 2 * reach) copies *= 2;
        }
        if (!faces) copies *= 2;
    }
    return copies;
}

}  // namespace natator::cuda
