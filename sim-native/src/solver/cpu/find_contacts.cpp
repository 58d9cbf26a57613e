#include <algorithm>

#include "substep.h"

namespace natator::cpu {

/// Lists the pairs that are not both fluid and closer than the radius plus margin at the predicted positions, in both
/// directions that collide (a pair of one group may be felt by one side only). Pairs at distance 0 are left out.
template <class Real>
void Substep<Real>::find_contacts() {
    const Real distance_squared = constants_.search_distance * constants_.search_distance;
    std::vector<std::pair<int, int>>& pairs = pairs_;
    pairs.clear();
    const auto visit_run = [&](int slot, int begin, int end, bool both_directions) {
        const int i = ws_.particle_of[slot];
        for (int other = begin; other < end; ++other) {
            const Real r2 = (position_of_slot(slot) - position_of_slot(other)).squaredNorm();
            if (!(r2 > 0) || !(r2 < distance_squared)) continue;
            const int j = ws_.particle_of[other];
            const bool mutual = plan_.mutual_contacts && (collides(i, j) || collides(j, i));
            if (mutual || collides(i, j)) pairs.emplace_back(slot, other);
            if (both_directions && (mutual || collides(j, i))) pairs.emplace_back(other, slot);
        }
    };
    for (int slot = ws_.solid_begin; slot < ws_.slots; ++slot) {
        ws_.grid.for_each_run(ws_.position.x[slot], ws_.position.y[slot], ws_.position.z[slot],
                              [&](int first, int last) {
                                  visit_run(slot, ws_.fluid_cell_begin[first], ws_.fluid_cell_begin[last + 1], true);
                                  visit_run(slot, ws_.solid_cell_begin[first], ws_.solid_cell_begin[last + 1], false);
                              });
    }
    std::sort(pairs.begin(), pairs.end());

    ws_.touched.clear();
    ws_.contact_begin.clear();
    ws_.contact.clear();
    for (const auto& [slot, other] : pairs) {
        if (ws_.touched.empty() || ws_.touched.back() != slot) {
            ws_.touched.push_back(slot);
            ws_.contact_begin.push_back(static_cast<int>(ws_.contact.size()));
        }
        ws_.contact.push_back(other);
    }
    ws_.contact_begin.push_back(static_cast<int>(ws_.contact.size()));
}

/// Lists the planes that each particle is within collisionDistance plus margin of, last plane first.
template <class Real>
void Substep<Real>::find_plane_contacts() {
    ws_.plane_contacts.clear();
    for (int plane = static_cast<int>(model_.planes.size()) - 1; plane >= 0; --plane) {
        const Vector3<Real> normal = model_.planes[plane].normal.template cast<Real>();
        const Real offset = static_cast<Real>(model_.planes[plane].offset);
        const auto visit = [&](int begin, int end) {
            for (int slot = begin; slot < end; ++slot)
                if (normal.dot(position_of_slot(slot)) + offset <= constants_.plane_search_distance &&
                    ws_.inverse_mass[slot] > 0)
                    ws_.plane_contacts.push_back({slot, plane});
        };
        visit(0, ws_.fluid);
        visit(ws_.solid_begin, ws_.slots);
    }
}

template void Substep<float>::find_contacts();
template void Substep<double>::find_contacts();
template void Substep<float>::find_plane_contacts();
template void Substep<double>::find_plane_contacts();

}  // namespace natator::cpu
