#pragma once

// The neighbours of the water in scheme conserving, and the loops over them. A warp's pair_lanes threads share a slot.
#include <cuda/std/tuple>

#include "found_neighbours.cuh"
#include "solver/cuda/grid/pair_gradient.cuh"
#include "solver/solids/cuda/body_momentum.cuh"

namespace natator::cuda {

/// Source of the pairs in sums, with the same bits.
enum class Pairs {
    listed,    ///< lists and gradients that are kept for a substep
    searched,  ///< nothing but places: slower, in less memory
};

template <class Real>
__device__ Vec3<Real> sum_of_lanes(const Vec3<Real>& v) {
    return {sum_of_lanes(v.x), sum_of_lanes(v.y), sum_of_lanes(v.z)};
}
template <class Real>
__device__ physics::Symmetric3<Real> sum_of_lanes(const physics::Symmetric3<Real>& m) {
    return {sum_of_lanes(m.xx), sum_of_lanes(m.yy), sum_of_lanes(m.zz),
            sum_of_lanes(m.xy), sum_of_lanes(m.xz), sum_of_lanes(m.yz)};
}
template <class Real>
__device__ Real max_of_lanes(Real value) {
    for (int step = pair_lanes / 2; step > 0; step /= 2) {
        const Real other = __shfl_xor_sync(0xffffffff, value, step);
        value = other > value ? other : value;
    }
    return value;
}

/// Number of neighbours of slot s that are this thread's share.
template <class Real>
__device__ int own_neighbours(const Slots<Real>& slots, int s) {
    return (slots.water.count[s] - own_lane() + pair_lanes - 1) / pair_lanes;
}

/// Values of each of the arrays at the slot of an entry.
template <class... Value>
__device__ ::cuda::std::tuple<Value...> values_at(unsigned entry, const Value*... array) {
    return ::cuda::std::tuple<Value...>(array[entry & slot_mask]...);
}

/// Calls visit(slot, boundaries, values...) for an entry.
template <class Visit, class... Value>
__device__ void visit_entry(unsigned entry, const ::cuda::std::tuple<Value...>& there, const Visit& visit) {
    const int slot = static_cast<int>(entry & slot_mask);
    const unsigned boundaries = entry >> max_slot_bits;
    ::cuda::std::apply([&](const Value&... value) { visit(slot, boundaries, value...); }, there);
}

/// Calls visit(place, own, slot, boundaries, values...) for this thread's share of the neighbours of slot s, with what
/// `own_at` reads at the neighbour's place in the list and with what is at its slot in each of the arrays. Those of
/// `batch` neighbours are under way at a time, and the entries of the next.
template <int batch, class Real, class OwnAt, class Visit, class... Value>
__device__ void for_each_water_entry(const Slots<Real>& slots, int s, const OwnAt& own_at, const Visit& visit,
                                     const Value*... array) {
    const std::size_t first = slots.water_place(s) + reversed_list(own_lane());
    const int count = own_neighbours(slots, s);
    const auto place_of_own = [&](int k) { return first + water_row * min(k, count - 1); };
    unsigned next[batch];
    if (count > 0)
        for (int k = 0; k < batch; ++k) next[k] = read_once(slots.water.neighbour + place_of_own(k));
    for (int begin = 0; begin < count; begin += batch) {
        unsigned entry[batch];
        decltype(own_at(first)) own[batch];
        ::cuda::std::tuple<Value...> there[batch];
#pragma unroll
        for (int k = 0; k < batch; ++k) {
            entry[k] = next[k];
            own[k] = own_at(place_of_own(begin + k));
            there[k] = values_at(entry[k], array...);
        }
#pragma unroll
        for (int k = 0; k < batch; ++k) next[k] = read_once(slots.water.neighbour + place_of_own(begin + batch + k));
#pragma unroll
        for (int k = 0; k < batch; ++k) {
            if (begin + k >= count) break;
            visit_entry(entry[k], there[k], [&](int slot, unsigned boundaries, const Value&... value) {
                visit(first + water_row * (begin + k), own[k], slot, boundaries, value...);
            });
        }
    }
}

struct Nothing {};

/// Calls visit(place in the list, slot, boundaries, values...) for each of them; the place means nothing where they are
/// searched, and the slots of all threads that call it are below `end`.
template <Pairs pairs, int batch, class Real, class Visit, class... Value>
__device__ void for_each_water_neighbour(const ModelView<Real>& model, const Slots<Real>& slots, int s, int end,
                                         const Visit& visit, const Value*... array) {
    if constexpr (pairs == Pairs::listed)
        for_each_water_entry<batch>(
            slots, s, [](std::size_t) { return Nothing(); },
            [&](std::size_t place, Nothing, int slot, unsigned boundaries, const Value&... value) {
                visit(place, slot, boundaries, value...);
            },
            array...);
    else
        for_each_found(
            model, slots, s, end, true, own_lane(),
            [](int, const Vec4<Real>& candidate) { return entry_of(candidate); },
            [&](unsigned entry) {
                visit_entry(entry, values_at(entry, array...),
                            [&](int slot, unsigned boundaries, const Value&... value) {
                                visit(std::size_t{0}, slot, boundaries, value...);
                            });
            });
}

}  // namespace natator::cuda
