// Starts that overlap. What a scene, a request or a hand put too close is pushed apart at a limited acceleration (see
// overlap_acceleration) instead of within one substep, which would fling it away: the pressure between overlapping
// particles is limited, so that a compressed block expands like a gas of that pressure, however far it is compressed.
// Nothing here acts as long as particles come close by their own motion.
#include <algorithm>
#include <cmath>

#include "conserving_stages.h"
#include "physics/plane.h"

namespace natator::cpu {

template <class Real>
Vec3<Real> ConservingStages<Real>::before_planes(Vec3<Real> x, Real distance) const {
    for (const Plane& plane : model_.planes)
        x = put_before(physics::PlaneSurface<Real>{vec3<Real>(plane.normal.template cast<Real>()),
                                                   static_cast<Real>(plane.offset)},
                       distance, x);
    return x;
}

template <class Real>
void ConservingStages<Real>::predict() {
    for (int i = 0; i < ws_.particles; ++i)
        if (inverse_mass_[i] > 0)
            state_->position[i] = eigen(before_planes(vec3(state_->position[i]), constants_.collision_distance));
    Substep<Real>::predict();
}

template <class Real>
Real ConservingStages<Real>::contact_depth(int i, int j) const {
    return physics::limited_depth(
        constants_.solid_rest_distance, norm(position_of_slot(i) - position_of_slot(j)), overlap_push_,
        [&] { return norm(start_of_slot(i) - start_of_slot(j)); }, [&] { return norm(base_.at(i) - base_.at(j)); });
}

/// Finds the fluid particles that start the substep more than 10 % above rest density, true if there are any. Looks
/// only if one of them is now; leaves densities and lambda as it found them. Pairs that are apart by now are left out.
template <class Real>
bool ConservingStages<Real>::find_overlap() {
    const auto end = ws_.density.begin() + ws_.fluid;
    if (!(*std::max_element(ws_.density.begin(), end) > 1 + Real(physics::overlap_tolerance))) return false;
    DensityView<Real> view = density_view();
    view.position[0] = ws_.start.x.data();
    view.position[1] = ws_.start.y.data();
    view.position[2] = ws_.start.z.data();
    compute_lambda_of_fluid(view);
    std::fill(lambda_sum_.begin(), lambda_sum_.end(), Real(0));
    std::fill(overlap_lambda_.begin(), overlap_lambda_.end(), Real(0));
    bool any = false;
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Real above = ws_.density[slot] - 1;
        overlap_[slot] = above > Real(physics::overlap_tolerance) ? above : 0;
        any |= overlap_[slot] > 0;
    }
    compute_lambda();
    return any;
}

template <class Real>
void ConservingStages<Real>::limit_overlap_pressure() {
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Real w = ws_.inverse_mass[slot];
        if (!(overlap_[slot] > 0) || !(w > 0)) continue;
        const Real limited = physics::limited_lambda(ws_.density[slot] - 1, response_[slot], overlap_[slot],
                                                     overlap_push_, w, own_.gradient_scale, overlap_lambda_[slot]);
        lambda_sum_[slot] += limited - lambda_[slot];
        lambda_[slot] = limited;
    }
}

/// Keeps a pair only if both particles keep it, where lists are full: else one would push the other without being
/// pushed. Lists hold maxNeighborsPerParticle, and at least four times what the rest packing has.
template <class Real>
void ConservingStages<Real>::find_fluid_neighbours() {
    Substep<Real>::find_fluid_neighbours();
    const int most = this->most_neighbours_;
    const auto end = ws_.neighbour_count.begin() + ws_.fluid;
    if (*std::max_element(ws_.neighbour_count.begin(), end) < most) return;
    const auto entry = [this](int slot, int k) -> std::int32_t& {
        const std::size_t row = ws_.row_begin[slot / lanes] + k;
        return ws_.neighbour[row * lanes + slot % lanes];
    };
    const auto lists = [&](int slot, int other) {
        for (int k = 0; k < ws_.neighbour_count[slot]; ++k)
            if (entry(slot, k) == other) return true;
        return false;
    };
    std::vector<std::pair<int, int>> one_sided;
    for (int slot = 0; slot < ws_.fluid; ++slot)
        for (int k = 0; k < ws_.neighbour_count[slot]; ++k) {
            const int other = entry(slot, k);
            if (ws_.neighbour_count[other] == most && !lists(other, slot)) one_sided.push_back({slot, k});
        }
    // From the back, as removing an entry moves those behind it.
    for (auto pair = one_sided.rbegin(); pair != one_sided.rend(); ++pair) {
        const auto [slot, k] = *pair;
        const int last = --ws_.neighbour_count[slot];
        for (int next = k; next < last; ++next) entry(slot, next) = entry(slot, next + 1);
        entry(slot, last) = ws_.slots;
    }
}

template Vec3<float> ConservingStages<float>::before_planes(Vec3<float>, float) const;
template Vec3<double> ConservingStages<double>::before_planes(Vec3<double>, double) const;
template void ConservingStages<float>::predict();
template void ConservingStages<double>::predict();
template float ConservingStages<float>::contact_depth(int, int) const;
template double ConservingStages<double>::contact_depth(int, int) const;
template bool ConservingStages<float>::find_overlap();
template bool ConservingStages<double>::find_overlap();
template void ConservingStages<float>::limit_overlap_pressure();
template void ConservingStages<double>::limit_overlap_pressure();
template void ConservingStages<float>::find_fluid_neighbours();
template void ConservingStages<double>::find_fluid_neighbours();

}  // namespace natator::cpu
