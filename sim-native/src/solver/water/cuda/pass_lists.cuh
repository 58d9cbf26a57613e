#pragma once

// How the passes of the water go through its lists: with as many threads for a slot as there is work for.
#include "water_gradients.cuh"

namespace natator::cuda {

/// Threads that share a slot: many_lanes where slots do not fill the GPU, few_lanes where they do, since each thread
/// has a cost of its own. The sums are the same to the last bit.
inline constexpr int many_lanes = water_lists, few_lanes = 2;

/// Values that lie side by side.
template <class T, int count>
struct Several {
    T of[count];
};

// Read at once, and only once in a kernel: see read_once.
template <int count, class T>
__device__ Several<T, count> read_several(const T* place) {
    Several<T, count> values;
    for (int k = 0; k < count; ++k) values.of[k] = read_once(place + k);
    return values;
}
template <>
__device__ inline Several<unsigned, 4> read_several<4>(const unsigned* place) {
    const uint4 four = __ldcs(reinterpret_cast<const uint4*>(place));
    return {four.x, four.y, four.z, four.w};
}
template <>
__device__ inline Several<PairGradient<float>, 4> read_several<4>(const PairGradient<float>* place) {
    const auto* const two = reinterpret_cast<const uint4*>(place);
    const uint4 first = __ldcs(two), second = __ldcs(two + 1);
    Several<PairGradient<float>, 4> gradients;
    gradients.of[0].kept = {first.x, first.y};
    gradients.of[1].kept = {first.z, first.w};
    gradients.of[2].kept = {second.x, second.y};
    gradients.of[3].kept = {second.z, second.w};
    return gradients;
}

/// What the thread `step` further on has, of those that share a slot.
template <class Real>
__device__ Real of_lane(Real value, int step) {
    return __shfl_xor_sync(0xffffffff, value, step);
}
template <class Real>
__device__ Vec3<Real> of_lane(const Vec3<Real>& v, int step) {
    return {of_lane(v.x, step), of_lane(v.y, step), of_lane(v.z, step)};
}

/// A sum over the neighbours of a slot that `lanes` threads share, by list of this thread. The total is added up in the
/// order of sum_of_lanes, however many lists a thread has: reversed_list sees to that.
template <int lanes, class Sum>
class ListSums {
public:
    __device__ Sum& operator[](int list) { return of_[list]; }
    __device__ Sum total() const {
        static_assert(own == 1 || own == 4);
        Sum sum = of_[0];
        if constexpr (own == 4) sum = (sum + of_[1]) + (of_[2] + of_[3]);
        for (int step = 1; step < lanes; step *= 2) sum = sum + of_lane(sum, step);
        return sum;
    }
    /// Is this the thread that speaks for the slot?
    __device__ static bool first_lane() { return threadIdx.x % lanes == 0; }

private:
    static constexpr int own = water_lists / lanes;
    Sum of_[own]{};
};

/// Calls visit(list, G_ij, boundaries, value) for the neighbours of slot s in the lists of this thread, which are
/// numbered from 0, once gradients are known; `value` is what is in `array` at the neighbour's slot. Lists that end
/// before others have neighbours with a gradient of 0. `rows` of the lists are under way at a time, and the values of
/// `gathers` neighbours.
template <int lanes, int rows, int gathers, class Real, class Visit, class Value>
__device__ void for_each_listed_pair(const Slots<Real>& slots, int s, const Visit& visit, const Value* array) {
    constexpr int own = water_lists / lanes;
    static_assert(rows * own % gathers == 0);
    const int lane = static_cast<int>(threadIdx.x) % lanes, count = slots.water.count[s];
    const int first_list = reversed_list(own * lane);
    const std::size_t first = slots.water_place(s) + own * lane;
    const int own_rows = (count - first_list + water_lists - 1) / water_lists;
    for (int begin = 0; begin < own_rows; begin += rows) {
        Several<unsigned, own> entry[rows];
        Several<PairGradient<Real>, own> gradient[rows];
#pragma unroll
        for (int r = 0; r < rows; ++r) {
            const int row = min(begin + r, own_rows - 1);
            const std::size_t place = first + water_row * row;
            entry[r] = read_several<own>(slots.water.neighbour + place);
            gradient[r] = read_several<own>(slots.water.pair + place);
#pragma unroll
            for (int list = 1; list < own; ++list)
                if (row * water_lists + first_list + reversed_list(list) >= count) {  // what stands there means nothing
                    entry[r].of[list] = entry[r].of[0];
                    gradient[r].of[list] = PairGradient<Real>::none();
                }
        }
#pragma unroll
        for (int done = 0; done < rows * own; done += gathers) {
            if (begin + done / own >= own_rows) break;
            Value there[gathers];
#pragma unroll
            for (int k = 0; k < gathers; ++k)
                there[k] = array[entry[(done + k) / own].of[(done + k) % own] & slot_mask];
#pragma unroll
            for (int k = 0; k < gathers; ++k) {
                const int r = (done + k) / own, list = (done + k) % own;
                if (begin + r >= own_rows) break;
                visit(list, gradient[r].of[list].value(), entry[r].of[list] >> max_slot_bits, there[k]);
            }
        }
    }
}

/// The same where there are no lists: a thread has what its one list would have.
template <int lanes, class Real, class Visit, class Value>
__device__ void for_each_searched_pair(const ModelView<Real>& model, const Slots<Real>& slots, int s, bool wanted,
                                       const Visit& visit, const Value* array) {
    static_assert(lanes == water_lists);
    const WaterArrays<Real>& water = slots.water;
    const GradientsOf<Real> own(model, water, s);
    for_each_found(
        model, slots, s, model.particles, wanted, reversed_list(own_lane()),
        [](int, const Vec4<Real>& candidate) { return entry_of(candidate); },
        [&](unsigned entry) {
            const auto add = [&](int, unsigned boundaries, const Vec4<Real>& there, const Vec4<Real>& correction,
                                 const Vec4<Real>& shear, const Value& value) {
                visit(0, own.kept(boundaries, there, correction, shear), boundaries, value);
            };
            visit_entry(entry, values_at(entry, water.position, water.correction, water.shear, array), add);
        });
}

/// Either, for none if they are not `wanted`.
template <Pairs pairs, int lanes, int rows, int gathers, class Real, class Visit, class Value>
__device__ void for_each_pass_pair(const ModelView<Real>& model, const Slots<Real>& slots, int s, bool wanted,
                                   const Visit& visit, const Value* array) {
    if constexpr (pairs == Pairs::searched)
        for_each_searched_pair<lanes>(model, slots, s, wanted, visit, array);
    else if (wanted)
        for_each_listed_pair<lanes, rows, gathers>(slots, s, visit, array);
}

// Rows and values that are under way at a time, by what is fetched of each neighbour.
template <int lanes>
inline constexpr int rows_of_velocities = lanes == many_lanes ? 2 : 1;
template <int lanes>
inline constexpr int rows_of_impulses = lanes == many_lanes ? 4 : 2;
inline constexpr int velocities_at_once = 2, impulses_at_once = 4;
// Blocks of few_lanes that shall fit on a multiprocessor, likewise.
inline constexpr int blocks_of_velocities = 5, blocks_of_impulses = 4;

}  // namespace natator::cuda
