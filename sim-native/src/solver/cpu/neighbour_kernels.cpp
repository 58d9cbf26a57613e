// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules. The templates over Real are the
// definition, and what double runs; beside each stands the same for vectors.
#include "neighbour_kernels.h"

#include "physics/pair.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

using namespace physics;

constexpr int lanes = 16;

template <class Real>
int find(const Real* const position[3], int slot, const SlotRuns& runs, Real distance_squared, std::int32_t* found) {
    const Real* const x = position[0];
    const Real* const y = position[1];
    const Real* const z = position[2];
    const Real xi = x[slot], yi = y[slot], zi = z[slot];
    int n = 0;
    for (int k = 0; k < runs.count; ++k) {
        const int end = runs.end[k];
        for (int j = runs.begin[k]; j < end; ++j) {
            const Real dx = xi - x[j], dy = yi - y[j], dz = zi - z[j];
            const Real r2 = dx * dx + dy * dy + dz * dz;
            found[n] = j;  // always written and only sometimes kept: no branch to mispredict
            n += (r2 < distance_squared) & (r2 > 0);
        }
    }
    return n;
}

template <class Real>
void find_two(const Real* const position[3], int slot, const SlotRuns& runs, Real distance_squared,
              std::int32_t* const found[2], int count[2]) {
    for (int k = 0; k < 2; ++k) count[k] = find(position, slot + k, runs, distance_squared, found[k]);
}

void interleave(const std::int32_t* const* list, const int* count, int rows, std::int32_t filler, std::int32_t* to) {
    for (int lane = 0; lane < lanes; ++lane)
        for (int row = 0; row < rows; ++row) to[row * lanes + lane] = row < count[lane] ? list[lane][row] : filler;
}

/// Of so many slots from `slot` on, which what is loaded serves all: `width` candidates at a time; the nearer ones move
/// to the front of their vector, which is written as a whole.
template <int slots>
inline void find_by_vectors(const float* const position[3], int slot, const SlotRuns& runs, float distance_squared,
                            std::int32_t* const* found, int* count) {
    const float* const x = position[0];
    const float* const y = position[1];
    const float* const z = position[2];
    Vec3<Floats> here[slots];
    std::int32_t* next[slots];
    for (int s = 0; s < slots; ++s) {
        here[s] = {all_lanes(x[slot + s]), all_lanes(y[slot + s]), all_lanes(z[slot + s])};
        next[s] = found[s];
    }
    const Floats limit = all_lanes(distance_squared);
    for (int k = 0; k < runs.count; ++k) {
        const int end = runs.end[k];
        for (int j = runs.begin[k]; j < end; j += width) {
            const Vec3<Floats> there{load_unaligned(x + j), load_unaligned(y + j), load_unaligned(z + j)};
            const unsigned within = first_lanes(end - j);
            for (int s = 0; s < slots; ++s) {
                const unsigned near = positive_and_below(squared_length(here[s] - there), limit) & within;
                next[s] += store_chosen(next[s], j, near);
            }
        }
    }
    for (int s = 0; s < slots; ++s) count[s] = static_cast<int>(next[s] - found[s]);
}

int find_one_by_vectors(const float* const position[3], int slot, const SlotRuns& runs, float distance_squared,
                        std::int32_t* found) {
    int count = 0;
    find_by_vectors<1>(position, slot, runs, distance_squared, &found, &count);
    return count;
}

void find_two_by_vectors(const float* const position[3], int slot, const SlotRuns& runs, float distance_squared,
                         std::int32_t* const found[2], int count[2]) {
    find_by_vectors<2>(position, slot, runs, distance_squared, found, count);
}

/// Squares of `width` lists by `width` rows, transposed in registers.
void interleave_by_vectors(const std::int32_t* const* list, const int* count, int rows, std::int32_t filler,
                           std::int32_t* to) {
    for (int row = 0; row < rows; row += width) {
        for (int lane = 0; lane < lanes; lane += width) {
            Ints square[width];
            for (int k = 0; k < width; ++k) square[k] = load_first(list[lane + k] + row, count[lane + k] - row, filler);
            transpose(square);
            for (int k = 0; k < width; ++k) store(to + (row + k) * lanes + lane, square[k]);
        }
    }
}

}  // namespace

template <class Real>
NeighbourKernels<Real> scalar_neighbour_kernels() {
    return {&find<Real>, &find_two<Real>, &interleave};
}

template NeighbourKernels<float> scalar_neighbour_kernels<float>();
template NeighbourKernels<double> scalar_neighbour_kernels<double>();

template <>
NeighbourKernels<double> neighbour_kernels<double>() {
    return scalar_neighbour_kernels<double>();
}

template <>
NeighbourKernels<float> neighbour_kernels<float>() {
    return {&find_one_by_vectors, &find_two_by_vectors, &interleave_by_vectors};
}

}  // namespace natator::cpu::NATATOR_ISA
