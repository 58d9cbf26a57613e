// Starts that overlap. What a scene, a request or a hand put too close is pushed apart at a limited acceleration (see
// overlap_acceleration) instead of within one substep, which would fling it away: the pressure between overlapping
// particles is limited, so that a compressed block expands like a gas of that pressure, however far it is compressed.
// Nothing here acts as long as particles come close by their own motion.
#include <algorithm>
#include <cmath>

#include "conserving_stages.h"

namespace natator::cpu {

/// Particles that start behind a plane are put on it before they move, which gives them no velocity: pre-stabilisation,
/// Macklin, Müller, Chentanez, Kim: Unified Particle Physics for Real-Time Applications (2014), 4.4.
template <class Real>
void ConservingStages<Real>::predict() {
    for (const Plane& plane : model_.planes) {
        const Vector3<Real> normal = plane.normal.template cast<Real>();
        const Real offset = static_cast<Real>(plane.offset) - constants_.collision_distance;
        for (int i = 0; i < ws_.particles; ++i) {
            const Real distance = normal.dot(state_->position[i]) + offset;
            if (distance < -overlap_tolerance<Real> * constants_.collision_distance && inverse_mass_[i] > 0)
                state_->position[i] -= distance * normal;
        }
    }
    Substep<Real>::predict();
}

/// Depth of a contact beyond what this substep may leave of it: a contact that was deep at the start gets shallower by
/// at most a h^2 in a substep, a = overlap_acceleration, or by what its motion does.
template <class Real>
Real ConservingStages<Real>::contact_depth(int i, int j) const {
    const Real rest = constants_.solid_rest_distance;
    const Real depth = rest - (position_of_slot(i) - position_of_slot(j)).norm();
    if (!(depth > overlap_push_)) return depth;
    const Real at_start = rest - (start_of_slot(i) - start_of_slot(j)).norm();
    if (!(at_start > overlap_push_)) return depth;
    const Real predicted = rest - (base_.at(i) - base_.at(j)).norm();
    return depth - std::max(std::min(at_start, predicted) - overlap_push_, Real(0));
}

/// Finds the fluid particles that start the substep more than 10 % above rest density, true if there are any. Looks
/// only if one of them is now; leaves densities and lambda as it found them. Pairs that are apart by now are left out.
template <class Real>
bool ConservingStages<Real>::find_overlap() {
    const auto end = ws_.density.begin() + ws_.fluid;
    if (!(*std::max_element(ws_.density.begin(), end) > 1 + overlap_tolerance<Real>)) return false;
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
        overlap_[slot] = above > overlap_tolerance<Real> ? above : 0;
        any |= overlap_[slot] > 0;
    }
    compute_lambda();
    return any;
}

/// Splits lambda_i where a particle began the substep with C_i = C0 > 0.1: what takes C_i back to C0 acts in full, what
/// takes it from C0 to 0 up to the lambda that moves a pair by a h^2 / (1 + C0)^(1/3) at most, so that the pressure
/// grows little with the number of pairs.
template <class Real>
void ConservingStages<Real>::limit_overlap_pressure() {
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        if (!(overlap_[slot] > 0) || !(ws_.inverse_mass[slot] > 0)) continue;
        const Real above = std::max(ws_.density[slot] - 1, Real(0));
        const Real most =
            overlap_push_ / (ws_.inverse_mass[slot] * own_.gradient_scale * std::cbrt(1 + overlap_[slot]));
        const Real wanted = std::min(above, overlap_[slot]) * response_[slot];
        const Real push = std::min(wanted, std::max(most - overlap_lambda_[slot], Real(0)));
        overlap_lambda_[slot] += push;
        const Real limited = -(std::max(above - overlap_[slot], Real(0)) * response_[slot] + push);
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
