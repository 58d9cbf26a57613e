// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules, but without fused products: every
// set gives the same bits. The compiler makes vectors of all loops.
#include "motion_kernels.h"

#include "lanes.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

constexpr int lanes = 16;

inline float square_root(float v) {
    return __builtin_sqrtf(v);
}
inline double square_root(double v) {
    return __builtin_sqrt(v);
}

/// In the order of a fixed-size vector's dot product elsewhere in the program. Of numbers, or of vectors of them.
template <class Lane, class Other>
inline Lane dot(Lane ax, Lane ay, Lane az, Other bx, Other by, Other bz) {
    return ax * bx + (ay * by + az * bz);
}

template <class Lane>
inline Lane length(Lane x, Lane y, Lane z) {
    return square_root(dot(x, y, z, x, y, z));
}

template <class Real>
void relax(const MotionView<Real>& slots, Real most, bool local) {
    constexpr int stretch = 16 * lanes;
    Real scale[stretch];
    for (int first = slots.first_block * lanes; first < slots.end_block * lanes; first += stretch) {
        const int rest = slots.end_block * lanes - first;
        const int size = rest < stretch ? rest : stretch;
        const Real* __restrict const count = slots.constraint_count + first;
        for (int k = 0; k < size; ++k) {
            const Real share = most / (count[k] > 1 ? count[k] : Real(1));
            scale[k] = share < 1 ? share : Real(1);
        }
        for (int k = 0; k < size && !local; ++k) scale[k] = most;
        for (int axis = 0; axis < 3; ++axis) {
            Real* __restrict const x = slots.position[axis] + first;
            const Real* __restrict const correction = slots.correction[axis] + first;
            for (int k = 0; k < size; ++k) x[k] += scale[k] * correction[k];
        }
    }
}

template <class Real>
void displacement_velocity(const MotionView<Real>& slots, Real inverse_h) {
    for (int axis = 0; axis < 3; ++axis) {
        const Real* __restrict const x = slots.position[axis];
        const Real* __restrict const start = slots.start[axis];
        Real* __restrict const velocity = slots.velocity[axis];
        for (int slot = slots.first_block * lanes; slot < slots.end_block * lanes; ++slot)
            velocity[slot] = (x[slot] - start[slot]) * inverse_h;
    }
}

/// Shortens the vectors that are longer than `longest`.
template <class Real>
inline void clamp(Real (&x)[lanes], Real (&y)[lanes], Real (&z)[lanes], Real longest) {
    for (int lane = 0; lane < lanes; ++lane) {
        const Real size = length(x[lane], y[lane], z[lane]);
        const Real scale = size > longest ? longest / size : Real(1);
        x[lane] *= scale;
        y[lane] *= scale;
        z[lane] *= scale;
    }
}

template <class Real>
void finish_velocity(const MotionView<Real>& slots, const VelocityRule<Real>& rule) {
    for (int block = slots.first_block; block < slots.end_block; ++block) {
        const int first = block * lanes;
        Real v[3][lanes];
        for (int axis = 0; axis < 3; ++axis) {
            const Real* const u = slots.velocity[axis] + first;
            const Real* const change = slots.correction[axis] + first;
            for (int lane = 0; lane < lanes; ++lane) v[axis][lane] = u[lane];
            if (block < rule.viscous_blocks)
                for (int lane = 0; lane < lanes; ++lane) v[axis][lane] += rule.viscosity_step * change[lane];
            if (rule.damping)
                for (int lane = 0; lane < lanes; ++lane) v[axis][lane] -= rule.damping_step * u[lane];
        }
        if (rule.clamp_acceleration) {
            for (int axis = 0; axis < 3; ++axis)
                for (int lane = 0; lane < lanes; ++lane) v[axis][lane] -= slots.predicted[axis][first + lane];
            clamp(v[0], v[1], v[2], rule.most_change);
            for (int axis = 0; axis < 3; ++axis)
                for (int lane = 0; lane < lanes; ++lane)
                    v[axis][lane] = slots.predicted[axis][first + lane] + v[axis][lane];
        }
        if (rule.clamp_speed) clamp(v[0], v[1], v[2], rule.max_speed);
        for (int axis = 0; axis < 3; ++axis)
            for (int lane = 0; lane < lanes; ++lane) slots.velocity[axis][first + lane] = v[axis][lane];
    }
}

template <class Real>
bool finite(const Real* values, int count) {
    int bad = 0;
    for (int k = 0; k < count; ++k) bad |= values[k] - values[k] == 0 ? 0 : 1;
    return bad == 0;
}

}  // namespace

template <class Real>
MotionKernels<Real> motion_kernels() {
    return {&relax<Real>, &displacement_velocity<Real>, &finish_velocity<Real>, &finite<Real>};
}
template MotionKernels<float> motion_kernels<float>();
template MotionKernels<double> motion_kernels<double>();

}  // namespace natator::cpu::NATATOR_ISA
