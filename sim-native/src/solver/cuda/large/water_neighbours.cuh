#pragma once

// The lists of neighbours in scheme conserving, and the loops over them. A warp's pair_lanes threads share a slot.
#include <cuda/std/tuple>

#include "body_momentum.cuh"
#include "pair_gradient.cuh"
#include "water_ghosts.cuh"

namespace natator::cuda {

inline constexpr unsigned slot_mask = (1u << most_slot_bits) - 1;

/// Of the threads that share a slot.
__device__ inline int own_lane() {
    return static_cast<int>(threadIdx.x) % pair_lanes;
}
template <class Real>
__device__ Vec3<Real> sum_of_lanes(const Vec3<Real>& v) {
    return {sum_of_lanes(v.x), sum_of_lanes(v.y), sum_of_lanes(v.z)};
}
template <class Real>
__device__ Real largest_of_lanes(Real value) {
    for (int step = pair_lanes / 2; step > 0; step /= 2) {
        const Real other = __shfl_xor_sync(0xffffffff, value, step);
        value = other > value ? other : value;
    }
    return value;
}

/// Calls keep(k, entry) for neighbour k of a slot: what is within the kernel's support of it, solids and ghosts too, in the order of the
/// cells. Returns how many there are, 0 for no slot. Lanes of a warp stay together, those that have no candidate left as well.
template <class Real, class Keep>
__device__ int search_water(const ModelView<Real>& model, const Slots<Real>& slots, int slot, const Keep& keep) {
    const int lane = own_lane(), first_lane = static_cast<int>(threadIdx.x) % 32 - lane;
    const int s = min(slot, model.particles - 1);
    const WaterArrays<Real>& water = slots.water;
    const GridView<Real>& grid = model.water.grid;
    const Vec3<Real> x = xyz(water.position[s]);
    const Real distance_squared = model.water.radius * model.water.radius;
    const unsigned lanes_before = (1u << lane) - 1;
    const int cx = grid.coordinate(x.x, 0), cy = grid.coordinate(x.y, 1), cz = grid.coordinate(x.z, 2);
    const int low = max(cx - grid.reach_x, 0), high = min(cx + grid.reach_x, grid.count[0] - 1);
    int n = 0;
    for (int around = 0; around < 9; ++around) {
        const int iy = cy + around % 3 - 1, iz = cz + around / 3 - 1;
        int from = 0, to = 0;
        if (slot == s && iy >= 0 && iy < grid.count[1] && iz >= 0 && iz < grid.count[2]) {
            const int row = (iz * grid.count[1] + iy) * grid.count[0];
            from = row + low > 0 ? water.table[row + low - 1] : 0;
            to = min(water.table[row + high], slots.water_room.copies);
        }
        int most = to - from;
        for (int step = pair_lanes; step < 32; step *= 2) most = max(most, __shfl_xor_sync(0xffffffff, most, step));
        for (int k = from + lane; most > 0; most -= pair_lanes, k += pair_lanes) {
            Quad<Real> other{};
            bool near = k < to;
            if (near) {
                other = water.candidate[k];
                const Real r2 = physics::squared_length(x - xyz(other));
                near = r2 < distance_squared && r2 > 0;
            }
            const unsigned found = __ballot_sync(0xffffffff, near) >> first_lane & ((1u << pair_lanes) - 1);
            if (near) keep(n + __popc(found & lanes_before), static_cast<unsigned>(number_in(other.w)));
            n += __popc(found);
        }
    }
    return n;
}

/// Gives the slots of a row so many rows. Returns the first, -1 where there is no room for all, and notes what they need. One thread.
template <class Real>
__device__ int take_rows(const Slots<Real>& slots, int rows) {
    const int first = atomicAdd(&slots.shared().rows, rows), end = first + rows;
    if (end <= slots.water_room.lists) return first;
    atomicMax(&slots.shared().needed.lists, end);
    return -1;
}

/// Lists the neighbours of every slot. A block has the slots of a row: it searches them into lists on the chip, which have room for
/// `staged` neighbours each, and then knows how many rows they need. Where some are longer, it searches once more.
template <int staged, class Real>
__device__ void find_water_neighbours_large(const ModelView<Real>& model, const Slots<Real>& slots) {
    constexpr int stride = staged + water_lists;  // lists of a warp begin in banks of their own
    __shared__ unsigned staging[slots_of_row * stride];
    __shared__ int longest, first_row;
    const int row = static_cast<int>(blockIdx.x), lane = own_lane(), own = static_cast<int>(threadIdx.x) / water_lists;
    const int slot = row * slots_of_row + own;
    unsigned* const list = staging + own * stride;
    if (threadIdx.x == 0) longest = 0;
    const int n = search_water(model, slots, slot, [&](int k, unsigned entry) {
        if (k < staged) list[k] = entry;
    });
    __syncthreads();
    if (lane == 0) atomicMax(&longest, n);
    __syncthreads();
    const int rows = (longest + water_lists - 1) / water_lists;
    if (threadIdx.x == 0) {
        first_row = take_rows(slots, rows);
        slots.water.first_row[row] = max(first_row, 0);
    }
    __syncthreads();
    if (lane == 0 && slot < model.particles) {
        slots.water.count[slot] = first_row < 0 ? 0 : n;
        slots.water.count_of[number_in(slots.at.state_velocity[slot].w)] = n;
    }
    if (first_row < 0) return;
    unsigned* const place = slots.water.neighbour + static_cast<std::size_t>(first_row) * water_row;
    if (longest > staged) {
        search_water(model, slots, slot, [&](int k, unsigned entry) { place[own * water_lists + place_of(k)] = entry; });
        return;
    }
    for (int k = reversed_list(lane), r = 0; k < n; k += water_lists, ++r) place[r * water_row + threadIdx.x] = list[k];
}

/// How many of the neighbours of slot s are this thread's share.
template <class Real>
__device__ int own_neighbours(const Slots<Real>& slots, int s) {
    return (slots.water.count[s] - own_lane() + pair_lanes - 1) / pair_lanes;
}

/// What is in each of the arrays at the slot of an entry.
template <class... Value>
__device__ ::cuda::std::tuple<Value...> values_at(unsigned entry, const Value*... array) {
    return ::cuda::std::tuple<Value...>(array[entry & slot_mask]...);
}

/// Calls visit(slot, borders, values...) for an entry.
template <class Visit, class... Value>
__device__ void visit_entry(unsigned entry, const ::cuda::std::tuple<Value...>& there, const Visit& visit) {
    const int slot = static_cast<int>(entry & slot_mask);
    const unsigned borders = entry >> most_slot_bits;
    ::cuda::std::apply([&](const Value&... value) { visit(slot, borders, value...); }, there);
}

/// Calls visit(place, own, slot, borders, values...) for this thread's share of the neighbours of slot s, with what `own_at` reads at
/// the neighbour's place in the list and with what is at its slot in each of the arrays. Those of `batch` neighbours are under
/// way at a time.
template <int batch, class Real, class OwnAt, class Visit, class... Value>
__device__ void for_each_water_entry(const Slots<Real>& slots, int s, const OwnAt& own_at, const Visit& visit,
                                     const Value*... array) {
    const std::size_t first = slots.water_place(s) + reversed_list(own_lane());
    const int count = own_neighbours(slots, s);
    for (int begin = 0; begin < count; begin += batch) {
        unsigned entry[batch];
        decltype(own_at(first)) own[batch];
        ::cuda::std::tuple<Value...> there[batch];
#pragma unroll
        for (int k = 0; k < batch; ++k) {
            const std::size_t place = first + water_row * min(begin + k, count - 1);
            entry[k] = read_once(slots.water.neighbour + place);
            own[k] = own_at(place);
        }
#pragma unroll
        for (int k = 0; k < batch; ++k) there[k] = values_at(entry[k], array...);
#pragma unroll
        for (int k = 0; k < batch; ++k) {
            if (begin + k >= count) break;
            visit_entry(entry[k], there[k], [&](int slot, unsigned borders, const Value&... value) {
                visit(first + water_row * (begin + k), own[k], slot, borders, value...);
            });
        }
    }
}

struct Nothing {};

/// Calls visit(place in the list, slot, borders, values...) for each of them.
template <int batch, class Real, class Visit, class... Value>
__device__ void for_each_water_neighbour(const Slots<Real>& slots, int s, const Visit& visit, const Value*... array) {
    for_each_water_entry<batch>(
        slots, s, [](std::size_t) { return Nothing(); },
        [&](std::size_t place, Nothing, int slot, unsigned borders, const Value&... value) {
            visit(place, slot, borders, value...);
        },
        array...);
}

/// The same with G_ij instead of the place, once gradients are known.
template <int batch = 4, class Real, class Visit, class... Value>
__device__ void for_each_water_pair(const Slots<Real>& slots, int s, const Visit& visit, const Value*... array) {
    for_each_water_entry<batch>(
        slots, s, [&](std::size_t place) { return read_once(slots.water.pair + place); },
        [&](std::size_t, const PairGradient<Real>& gradient, int slot, unsigned borders, const Value&... value) {
            visit(gradient.value(), slot, borders, value...);
        },
        array...);
}

}  // namespace natator::cuda
