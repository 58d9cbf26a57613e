// Which slots the particles of the water and their ghosts have in a substep, cell by cell, and the neighbours of each.
#include <algorithm>

#include "physics/constants.h"
#include "solver/cpu/bounding_box.h"
#include "solver/cpu/workspace.h"
#include "water.h"

namespace natator::cpu {

template <class Real>
const std::vector<Vector3<Real>>& Water<Real>::places_in_tank(const State<Real>& state) {
    if (periodic_axes_.empty()) return state.position;
    in_tank_ = state.position;
    for (Vector3<Real>& x : in_tank_)
        for (const physics::PeriodicAxis<Real>& periodic : periodic_axes_) x = eigen(to_tank(periodic, vec3(x)));
    return in_tank_;
}

/// The grid, the cells of the particles, and where the slots of each cell begin.
template <class Real>
void Water<Real>::sort_into_cells(const std::vector<Vector3<Real>>& position, const std::vector<Ghost>& ghosts,
                                  ThreadTeam& team) {
    Box<Real> box = bounding_box(position, team);
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] -= radius_;  // ghosts that are further out are in the border cells
        box.high[axis] += radius_;
    }
    grid_.cover(box.low, box.high, radius_, 4096 + 16 * particles_);
    const auto cell = [this](const auto& x) { return grid_.cell(x.x(), x.y(), x.z()); };

    for_each_slot(team, [&](int i) { cell_of_[i] = cell(position[i]); });
    cell_begin_.assign(grid_.cells() + 1, 0);
    for (const int of_particle : cell_of_) ++cell_begin_[of_particle + 1];
    ghost_cell_begin_.assign(grid_.cells() + 1, 0);
    for (const auto& ghost : ghosts) ++ghost_cell_begin_[cell(ghost.position) + 1];
    ghost_cell_begin_[0] = ghost_begin_;
    for (int c = 0; c < grid_.cells(); ++c) {
        cell_begin_[c + 1] += cell_begin_[c];
        ghost_cell_begin_[c + 1] += ghost_cell_begin_[c];
    }
}

template <class Real>
void Water<Real>::make_room(std::size_t slots) {
    if (position_.x.size() >= slots) return;
    const std::size_t room = round_up_to_block(static_cast<int>(slots + slots / 8));
    for (auto* array : {&position_, &velocity_}) array->resize(room);
    for (auto* array : {&volume_, &inverse_mass_, &mobility_, &impulse_}) array->resize(room);
    for (auto* array : {&packed_, &packed_velocity_, &packed_correction_, &packed_shear_, &packed_zeroth_order_})
        array->resize(4 * room);
}

/// Numbers the slots by cell, first of the particles, then of the ghosts.
template <class Real>
void Water<Real>::lay_out(const State<Real>& state, ThreadTeam& team) {
    const std::vector<Vector3<Real>>& position = places_in_tank(state);
    const auto& ghosts = ghosts_.find(position, radius_, team);
    sort_into_cells(position, ghosts, team);
    far_slot_ = ghost_begin_ + static_cast<int>(ghosts.size());

    const std::size_t all = round_up_to_block(far_slot_ + 1) + lanes;  // what searches may read behind the last slot
    make_room(all);
    const auto cell = [this](const auto& x) { return grid_.cell(x.x(), x.y(), x.z()); };
    const auto put = [this](int slot, int particle, const auto& x, const auto& v) {
        position_.set(slot, vec3<Real>(x));
        velocity_.set(slot, vec3<Real>(v));
        volume_[slot] = volume_of_[particle];
        inverse_mass_[slot] = inverse_mass_of_[particle];
        mobility_[slot] = mobility_of_[particle];
    };
    const auto put_nothing = [this](int slot) {
        position_.set(slot, {Real(physics::far_away), Real(physics::far_away), Real(physics::far_away)});
        velocity_.set(slot, {});
        volume_[slot] = inverse_mass_[slot] = mobility_[slot] = impulse_[slot] = 0;
    };
    std::vector<int> next(cell_begin_.begin(), cell_begin_.end() - 1);
    for (int i = 0; i < particles_; ++i) {
        slot_of_[i] = next[cell_of_[i]]++;
        particle_of_[slot_of_[i]] = i;
    }
    for_each_slot(team, [&](int slot) {
        const int i = particle_of_[slot];
        solid_[slot] = model_.is_fluid(i) ? Real(0) : Real(1);
        put(slot, i, position[i], state.velocity[i]);
    });
    for (int slot = particles_; slot < ghost_begin_; ++slot) put_nothing(slot);
    next.assign(ghost_cell_begin_.begin(), ghost_cell_begin_.end() - 1);
    ghost_owner_.resize(ghosts.size());
    ghost_transform_.resize(ghosts.size());
    ghost_slot_.clear();
    for (const auto& ghost : ghosts) ghost_slot_.push_back(next[cell(ghost.position)]++);
    for_each_ghost(team, [&](int k) {
        const auto& ghost = ghosts[k];
        const int slot = ghost_slot_[k];
        ghost_owner_[slot - ghost_begin_] = slot_of_[ghost.particle];
        ghost_transform_[slot - ghost_begin_] = ghost.transform;
        put(slot, ghost.particle, ghost.position,
            (ghosts_.matrix(ghost.transform) * state.velocity[ghost.particle]).eval());
    });
    for (int slot = far_slot_; slot < static_cast<int>(all); ++slot) put_nothing(slot);
}

/// Lists the neighbours of all particles: particles and ghosts.
template <class Real>
void Water<Real>::list_neighbours(ThreadTeam& team) {
    const auto cell_of = [this](int slot) { return slot < particles_ ? cell_of_[particle_of_[slot]] : -1; };
    const auto go_to = [this](Surroundings<Real>& around, int cell) {
        around.go_to(grid_, cell, cell_begin_, ghost_cell_begin_);
    };
    const std::size_t size = lists_.list({.position = {position_.x.data(), position_.y.data(), position_.z.data()},
                                          .blocks = ghost_begin_ / lanes,
                                          .distance_squared = radius_ * radius_,
                                          .filler = far_slot_,
                                          .min_part = min_part,
                                          .kernels = neighbour_kernels_},
                                         team, {row_begin_, neighbour_, neighbour_count_}, cell_of, go_to,
                                         [](int, std::int32_t*, int n) { return n; });
    if (distance_.size() >= size) return;
    distance_.resize(neighbour_.size());
    gradient_.resize(neighbour_.size());
}

template <class Real>
void Water<Real>::find_neighbours(const State<Real>& state, Real h, ThreadTeam& team) {
    h_ = h;
    lay_out(state, team);
    list_neighbours(team);
    on_all_threads(team, kernels_->pack);
    const auto pack = [this](int slot) {
        const Real quadruples[8] = {position_.x[slot], position_.y[slot], position_.z[slot], volume_[slot],
                                    velocity_.x[slot], velocity_.y[slot], velocity_.z[slot], mobility_[slot]};
        std::copy_n(quadruples, 4, packed_.begin() + 4 * static_cast<std::ptrdiff_t>(slot));
        std::copy_n(quadruples + 4, 4, packed_velocity_.begin() + 4 * static_cast<std::ptrdiff_t>(slot));
    };
    for_each_ghost(team, [&](int k) { pack(ghost_begin_ + k); });
    pack(far_slot_);
}

template void Water<float>::find_neighbours(const State<float>&, float, ThreadTeam&);
template void Water<double>::find_neighbours(const State<double>&, double, ThreadTeam&);

}  // namespace natator::cpu
