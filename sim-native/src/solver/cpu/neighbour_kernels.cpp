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

/// `width` slots at a time; the nearer ones move to the front of their vector, which is written as a whole.
int find_by_vectors(const float* const position[3], int slot, const SlotRuns& runs, float distance_squared,
                    std::int32_t* found) {
    const float* const x = position[0];
    const float* const y = position[1];
    const float* const z = position[2];
    const Floats xi = all_lanes(x[slot]), yi = all_lanes(y[slot]), zi = all_lanes(z[slot]);
    const Floats limit = all_lanes(distance_squared);
    int n = 0;
    for (int k = 0; k < runs.count; ++k) {
        const int end = runs.end[k];
        for (int j = runs.begin[k]; j < end; j += width) {
            const Floats dx = xi - load_unaligned(x + j);
            const Floats dy = yi - load_unaligned(y + j);
            const Floats dz = zi - load_unaligned(z + j);
            const Floats r2 = squared_length(Vec3<Floats>{dx, dy, dz});
            const unsigned near = positive_and_below(r2, limit) & first_lanes(end - j);
            n += store_chosen(found + n, j, near);
        }
    }
    return n;
}

/// What is loaded serves both.
void find_two_by_vectors(const float* const position[3], int slot, const SlotRuns& runs, float distance_squared,
                         std::int32_t* const found[2], int count[2]) {
    const float* const x = position[0];
    const float* const y = position[1];
    const float* const z = position[2];
    const Floats xa = all_lanes(x[slot]), ya = all_lanes(y[slot]), za = all_lanes(z[slot]);
    const Floats xb = all_lanes(x[slot + 1]), yb = all_lanes(y[slot + 1]), zb = all_lanes(z[slot + 1]);
    const Floats limit = all_lanes(distance_squared);
    std::int32_t *a = found[0], *b = found[1];
    for (int k = 0; k < runs.count; ++k) {
        const int end = runs.end[k];
        for (int j = runs.begin[k]; j < end; j += width) {
            const Floats xj = load_unaligned(x + j), yj = load_unaligned(y + j), zj = load_unaligned(z + j);
            const unsigned within = first_lanes(end - j);
            const Floats ra = squared_length(Vec3<Floats>{xa - xj, ya - yj, za - zj});
            const Floats rb = squared_length(Vec3<Floats>{xb - xj, yb - yj, zb - zj});
            a += store_chosen(a, j, positive_and_below(ra, limit) & within);
            b += store_chosen(b, j, positive_and_below(rb, limit) & within);
        }
    }
    count[0] = static_cast<int>(a - found[0]);
    count[1] = static_cast<int>(b - found[1]);
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
    return {&find_by_vectors, &find_two_by_vectors, &interleave_by_vectors};
}

}  // namespace natator::cpu::NATATOR_ISA
