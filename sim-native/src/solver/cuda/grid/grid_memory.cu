#include "grid_memory.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <numeric>
#include <utility>

#include "base/side_by_side.h"
#include "rows.h"
#include "scan.h"
#include "solver/cuda/device_states.h"
#include "substep.cuh"

namespace natator::cuda {
namespace {

constexpr int usual_neighbours = 32;      // of fluid in scheme flex: a lattice has 18, and it packs closer by half
constexpr int fluid_around_a_solid = 32;  // that has room for lists of contacts

template <class Real>
Real as_quad_number(int i) {
    if constexpr (sizeof(Real) == 4)
        return std::bit_cast<float>(i);
    else
        return std::bit_cast<double>(static_cast<long long>(i));
}

/// Particles of the water and their ghosts, as in a cube with walls on all sides.
template <class Real>
int usual_copies(const ModelView<Real>& size) {
    const double particles = size.particles;
    return static_cast<int>(std::min(size.water.max_copies * particles, particles + 20 * std::pow(particles, 2.0 / 3)));
}

/// A new array in a buffer, in place of the old one: both are never there.
template <class T>
void renew(DeviceBuffer<T>& buffer, std::size_t count, T*& array) {
    buffer = {};
    buffer = DeviceBuffer<T>(count);
    array = buffer.data();
}

}  // namespace

template <class Real>
GridMemory<Real>::GridMemory(const Model& model, const DeviceModel<Real>& device_model, int states,
                             const GridOptions& options, cudaStream_t stream)
    : model_(model),
      device_model_(device_model),
      view_(device_model.view()),
      states_(states),
      lists_(options.lists),
      stream_(stream),
      idle_(states, 0) {
    slots_.room = options.room;
    allocate(options.keeps_forces);
    const std::size_t particles = view_.particles;
    before_.position = DeviceBuffer<Vec4<Real>>(states * particles);
    before_.velocity = DeviceBuffer<Vec4<Real>>(states * particles);
    before_.fit = DeviceBuffer<ClusterFit<Real>>(states * std::size_t(view_.clusters));
    if (!view_.plan.water) return;
    make_room_for_copies(usual_copies(view_));
    list_water(blocks_for(view_.particles, slots_of_row) *
               blocks_for(usual_water_neighbours(model.parameters.conserving.kernel_support), water_lists));
}

/// The arrays of a State one behind the other, and so for each State.
template <class Real>
void GridMemory<Real>::allocate(bool keeps_forces) {
    const ModelView<Real>& size = view_;
    const Plan& plan = size.plan;
    const bool conserving = size.scheme != Scheme::flex;
    const std::size_t all = size.particles + 1, water = plan.water ? size.particles : 0;
    if (plan.contacts && plan.fluid) slots_.room.fluid_rows = std::min(size.fluid, fluid_around_a_solid * size.solids);
    // Water touches nothing: only its solids are in contacts.
    const std::size_t contact_slots = plan.water ? size.solids : all, not_in_water = plan.water ? 0 : all;
    const struct {
        std::size_t scratch_position, unsorted, contact_slots, neighbour_counts, cells, neighbours, fluid_contacts,
            solid_contacts;
    } room{not_in_water,
           not_in_water,
           contact_slots,
           not_in_water,
           std::size_t(2) * size.grid.cells,
           0,
           std::size_t(slots_.room.fluid_rows) * slots_.room.fluid,
           plan.contacts ? std::size_t(size.solids) * slots_.room.solid : 0};
    std::vector<std::pair<void**, std::size_t>> places;
    std::size_t bytes = 0;
    const auto give = [&](auto*& array, std::size_t count) {
        constexpr std::size_t alignment = 256;
        places.emplace_back(reinterpret_cast<void**>(&array), bytes);
        bytes += (count * sizeof *array + alignment - 1) / alignment * alignment;
    };
#define NATATOR_GIVE(type, name, count, ...) give(slots_.arrays.name, count);
    NATATOR_STATE_ARRAYS(NATATOR_GIVE)
#undef NATATOR_GIVE
#define NATATOR_GIVE(type, name, count) give(slots_.water.name, count);
    NATATOR_WATER_ARRAYS(NATATOR_GIVE)
#undef NATATOR_GIVE
    memory_ = DeviceBuffer<char>(bytes * states_);
    memory_.clear();  // slots are numbers, also in States that nobody advances
    for (const auto& [array, place] : places) *array = memory_.data() + place;
    if (plan.water) share_places();
    slots_.stride = bytes;
    shared_ = DeviceBuffer<GridShared<Real>>(states_);
    slots_.arrays.shared = shared_.data();
    device_idle_ = DeviceBuffer<int>(idle_);
    slots_.arrays.idle = device_idle_.data();
    scan_room_ = DeviceBuffer<char>(scan_bytes(std::max(2 * size.grid.cells, size.water.grid.cells), states_));
    if (plan.fluid) make_room_in_fluid(std::min(size.max_neighbours, usual_neighbours));
}

/// What the water needs for a part of a substep lies where something else does in another. Only solids have contacts,
/// whose slots come last.
template <class Real>
void GridMemory<Real>::share_places() {
    StateArrays<Real>& arrays = slots_.arrays;
    WaterArrays<Real>& water = slots_.water;
    arrays.unsorted_position = water.pushed;
    arrays.unsorted_velocity = water.zeroth_order_correction = water.crowding;
    arrays.scratch_position = water.separation;
    arrays.contact_push -= view_.fluid;
}

/// Lists with so many rows, or none. Without the memory for them nothing has changed, but that the old ones are gone.
template <class Real>
void GridMemory<Real>::list_water(int rows) {
    if (lists_ == WaterLists::never) return;
    try {
        make_room_for_rows(rows);
    } catch (const std::bad_alloc&) {
        if (lists_ == WaterLists::always) throw;
        lists_ = WaterLists::never;
        make_room_for_rows(0);
    }
}

/// In the water's lists of each State.
template <class Real>
void GridMemory<Real>::make_room_for_rows(int rows) {
    const std::size_t entries = static_cast<std::size_t>(rows) * water_row * states_;
    slots_.water_room.lists = rows;
    renew(neighbour_room_, entries, slots_.water.neighbour);
    renew(pair_room_, entries, slots_.water.pair);
}

/// Of the water's particles in each State: themselves and their ghosts.
template <class Real>
void GridMemory<Real>::make_room_for_copies(int copies) {
    const std::size_t all = static_cast<std::size_t>(copies) * states_;
    slots_.water_room.copies = copies;
    renew(key_room_, all, slots_.water.keys);
    renew(candidate_room_, all, slots_.water.candidate);
}

/// Likewise in the lists of scheme flex.
template <class Real>
void GridMemory<Real>::make_room_in_fluid(int neighbours) {
    slots_.chunks = (neighbours + 3) / 4;
    slots_.list_chunks = static_cast<std::size_t>(blocks_for(view_.fluid, 32)) * 32 * slots_.chunks;
    renew(chunk_room_, slots_.list_chunks * states_, slots_.arrays.neighbour);
}

template <class Real>
void GridMemory<Real>::make_room(ListRoom needed) {
    if (needed.copies > room().copies) make_room_for_copies(needed.copies);
    if (needed.lists <= room().lists) return;
    if (view_.plan.water)
        list_water(needed.lists);
    else
        make_room_in_fluid(std::min(needed.lists, view_.max_neighbours));
}

template <class Real>
void GridMemory<Real>::keep_before() const {
    const auto keep = [&](const auto& to, const auto* from, std::size_t count) {
        copy_rows(to.data(), count * sizeof *from, from, slots_.stride, count, states_, stream_);
    };
    keep(before_.position, slots_.arrays.state_position, view_.particles);
    keep(before_.velocity, slots_.arrays.state_velocity, view_.particles);
    keep(before_.fit, slots_.arrays.fit, view_.clusters);
}

template <class Real>
void GridMemory<Real>::keep_running(const GridLaunch<Real>& launch) const {
    launch_keep(launch, before_.position.data(), before_.velocity.data(), before_.fit.data());
}

template <class Real>
void GridMemory<Real>::restore_before(int k) const {
    const Slots<Real> slots = slots_.state(k);
    const auto restore = [&](auto* to, const auto& from, std::size_t count) {
        copy_row(to, from.data() + k * count, count, stream_);
    };
    restore(slots.arrays.state_position, before_.position, view_.particles);
    restore(slots.arrays.state_velocity, before_.velocity, view_.particles);
    restore(slots.arrays.fit, before_.fit, view_.clusters);
}

template <class Real>
void GridMemory<Real>::wait() const {
    check(cudaStreamSynchronize(stream_), "run");
}

/// Of a State, by device number.
template <class Real>
void GridMemory<Real>::to_rows(const State<Real>& state, Vec4<Real>* position, Vec4<Real>* velocity,
                               ClusterFit<Real>* fits) const {
    const std::vector<int>& number_of = device_model_.number_of();
    for (std::size_t i = 0; i < number_of.size(); ++i) {
        const Vector3<Real>&x = state.position[i], &v = state.velocity[i];
        const int number = number_of[i];
        position[number] = {x.x(), x.y(), x.z(), static_cast<Real>(model_.inverse_mass[i])};
        velocity[number] = {v.x(), v.y(), v.z(), as_quad_number<Real>(number)};
    }
    for (int c = 0; c < view_.clusters; ++c) {
        const Vector3<Real>& centre = state.cluster_centre[c];
        fits[c].centre = {centre.x(), centre.y(), centre.z()};
        for (int e = 0; e < 4; ++e) fits[c].rotation[e] = state.cluster_rotation[c].coeffs()[e];
    }
}

/// By slot, which the velocities have the device number of.
template <class Real>
void GridMemory<Real>::from_rows(const Vec4<Real>* position, const Vec4<Real>* velocity, const ClusterFit<Real>* fits,
                                 State<Real>& state) const {
    state.position = by_particle(device_model_, position, velocity);
    state.velocity = by_particle(device_model_, velocity, velocity);
    for (int c = 0; c < view_.clusters; ++c) {
        state.cluster_centre[c] = {fits[c].centre.x, fits[c].centre.y, fits[c].centre.z};
        for (int e = 0; e < 4; ++e) state.cluster_rotation[c].coeffs()[e] = fits[c].rotation[e];
    }
}

template <class Real>
void GridMemory<Real>::upload(int k, const State<Real>& state) const {
    const std::size_t particles = view_.particles;
    std::vector<Vec4<Real>> position(particles), velocity(particles);
    std::vector<ClusterFit<Real>> fits(view_.clusters);
    to_rows(state, position.data(), velocity.data(), fits.data());
    std::vector<int> slot_of_solid(view_.solids);
    std::iota(slot_of_solid.begin(), slot_of_solid.end(), view_.fluid);
    const Slots<Real> slots = slots_.state(k);
    const StateArrays<Real>& arrays = slots.arrays;
    copy_row(arrays.state_position, position.data(), particles, stream_);
    copy_row(arrays.state_velocity, velocity.data(), particles, stream_);
    copy_row(arrays.fit, fits.data(), fits.size(), stream_);
    copy_row(arrays.slot_of_solid, slot_of_solid.data(), slot_of_solid.size(), stream_);
    wait();
}

template <class Real>
State<Real> GridMemory<Real>::download(int k, const State<Real>& like) const {
    const std::size_t particles = view_.particles;
    std::vector<Vec4<Real>> position(particles), velocity(particles);
    std::vector<ClusterFit<Real>> fits(view_.clusters);
    const Slots<Real> slots = slots_.state(k);
    const StateArrays<Real>& arrays = slots.arrays;
    copy_row(position.data(), arrays.state_position, particles, stream_);
    copy_row(velocity.data(), arrays.state_velocity, particles, stream_);
    copy_row(fits.data(), arrays.fit, fits.size(), stream_);
    wait();
    State<Real> state = like;
    from_rows(position.data(), velocity.data(), fits.data(), state);
    return state;
}

template <class Real>
void GridMemory<Real>::stage() {
    if (staged_.position.size() > 0) return;
    const std::size_t states = states_;
    staged_.position = HostBuffer<Vec4<Real>>(states * view_.particles);
    staged_.velocity = HostBuffer<Vec4<Real>>(states * view_.particles);
    staged_.fit = HostBuffer<ClusterFit<Real>>(states * view_.clusters);
    staged_.slot_of_solid = HostBuffer<int>(states * view_.solids);
    for (std::size_t k = 0; k < states; ++k) {
        int* const of_state = staged_.slot_of_solid.data() + k * view_.solids;
        std::iota(of_state, of_state + view_.solids, view_.fluid);
    }
}

template <class Real>
void GridMemory<Real>::upload_all(const std::vector<const State<Real>*>& states) {
    stage();
    const std::size_t particles = view_.particles, clusters = view_.clusters, solids = view_.solids;
    side_by_side(
        states.size(),
        [&](std::size_t k) {
            to_rows(*states[k], staged_.position.data() + k * particles, staged_.velocity.data() + k * particles,
                    staged_.fit.data() + k * clusters);
        },
        states.size() / short_calls + 1);
    const StateArrays<Real>& arrays = slots_.arrays;
    const int rows = static_cast<int>(states.size());
    const auto copy = [&](auto* to, const auto* from, std::size_t count) {
        copy_rows(to, slots_.stride, from, count * sizeof *from, count, rows, stream_);
    };
    copy(arrays.state_position, staged_.position.data(), particles);
    copy(arrays.state_velocity, staged_.velocity.data(), particles);
    copy(arrays.fit, staged_.fit.data(), clusters);
    copy(arrays.slot_of_solid, staged_.slot_of_solid.data(), solids);
    wait();
}

template <class Real>
void GridMemory<Real>::download_all(const std::vector<State<Real>*>& states) {
    stage();
    const std::size_t particles = view_.particles, clusters = view_.clusters;
    const StateArrays<Real>& arrays = slots_.arrays;
    const int rows = static_cast<int>(states.size());
    const auto copy = [&](auto* to, const auto* from, std::size_t count) {
        copy_rows(to, count * sizeof *from, from, slots_.stride, count, rows, stream_);
    };
    copy(staged_.position.data(), arrays.state_position, particles);
    copy(staged_.velocity.data(), arrays.state_velocity, particles);
    copy(staged_.fit.data(), arrays.fit, clusters);
    wait();
    side_by_side(
        states.size(),
        [&](std::size_t k) {
            from_rows(staged_.position.data() + k * particles, staged_.velocity.data() + k * particles,
                      staged_.fit.data() + k * clusters, *states[k]);
        },
        states.size() / short_calls + 1);
}

template <class Real>
void GridMemory<Real>::set_idle(const std::vector<bool>& idle) {
    idle_.assign(idle.begin(), idle.end());
    device_idle_.upload(idle_);
    wait_for_uploads();
}

template class GridMemory<float>;
template class GridMemory<double>;

}  // namespace natator::cuda
