#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "model_view.h"

namespace natator::cuda {

/// First `transform`, then through one more boundary.
template <class Real>
GhostTransform<Real> through(const GhostTransform<Real>& transform, const physics::Boundary<Real>& boundary) {
    const Vec3<Real>& n = boundary.surface.normal;
    const Real component[3] = {n.x, n.y, n.z};
    GhostTransform<Real> both = transform;
    if (boundary.shift > 0) {
        for (int k = 0; k < 3; ++k) both.row[k].w += boundary.shift * component[k];
        return both;
    }
    Vec4<Real> along{0, 0, 0, boundary.surface.offset};
    for (int k = 0; k < 3; ++k) {
        const Vec4<Real>& row = transform.row[k];
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

/// The transforms from a particle to its ghosts behind each set of `boundaries`: entry k is for those whose bits are
/// set in k, passed in their order.
template <class Real>
std::vector<GhostTransform<Real>> ghost_transforms(const std::vector<physics::Boundary<Real>>& boundaries) {
    std::vector<GhostTransform<Real>> transforms(std::size_t(1) << boundaries.size());
    transforms[0] = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    for (std::size_t set = 1; set < transforms.size(); ++set) {
        const int last = std::bit_width(set) - 1;
        transforms[set] = through(transforms[set ^ std::size_t(1) << last], boundaries[last]);
    }
    return transforms;
}

/// Maximum number of copies of a particle, itself included. Each boundary within `reach` doubles it; of two that face
/// each other the second does so only if a particle can be near both.
template <class Real>
int max_copies(const std::vector<physics::Boundary<Real>>& boundaries, Real reach) {
    int copies = 1;
    for (std::size_t k = 0; k < boundaries.size(); ++k) {
        const physics::PlaneSurface<Real>& plane = boundaries[k].surface;
        bool faces = false;
        for (std::size_t e = 0; e < k; ++e) {
            const physics::PlaneSurface<Real>& other = boundaries[e].surface;
            if (!(dot(other.normal, plane.normal) < 0)) continue;
            faces = true;
            if (plane.offset + other.offset < 2 * reach) copies *= 2;
        }
        if (!faces) copies *= 2;
    }
    return copies;
}

}  // namespace natator::cuda
