// Compiled once per instruction set: NATATOR_ISA names the namespace, the compiler's flags choose the instructions.
// A block of 16 particles is worked on lane by lane, each lane with its own sums, so that the loops over `lane`
// vectorise without changing the order of any sum. Include nothing here that has inline functions.
#include "fluid_kernels.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

constexpr int lanes = 16;

float square_root(float v) {
    return __builtin_sqrtf(v);
}
double square_root(double v) {
    return __builtin_sqrt(v);
}

/// Keeps 1/r finite at r = 0, where the direction is 0 anyway; too small to change any other r^2.
template <class Real>
constexpr Real tiny = Real(1e-30);

template <class Real>
int append_neighbours(const FluidView<Real>& fluid, int slot, const SlotRun* runs, int run_count, Real distance_squared,
                      std::int32_t* found) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real xi = x[slot], yi = y[slot], zi = z[slot];
    int n = 0;
    for (int k = 0; k < run_count; ++k) {
        for (int j = runs[k].begin; j < runs[k].end; ++j) {
            const Real dx = xi - x[j], dy = yi - y[j], dz = zi - z[j];
            const Real r2 = dx * dx + dy * dy + dz * dz;
            found[n] = j;  // always written and only sometimes kept: no branch to mispredict
            n += (r2 < distance_squared) & (r2 > 0);
        }
    }
    return n;
}

template <class Real>
void compute_density(const FluidView<Real>& fluid) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = 0; block < fluid.blocks; ++block) {
        const int first = block * lanes;
        Real sum[lanes] = {};
        for (int row = fluid.row_begin[block]; row < fluid.row_begin[block + 1]; ++row) {
            const std::int32_t* const neighbour = fluid.neighbour + row * lanes;
            for (int lane = 0; lane < lanes; ++lane) {
                const int j = neighbour[lane];
                const Real dx = x[first + lane] - x[j];
                const Real dy = y[first + lane] - y[j];
                const Real dz = z[first + lane] - z[j];
                const Real one_minus_q = 1 - square_root(dx * dx + dy * dy + dz * dz) * inverse_radius;
                const Real t = one_minus_q > 0 ? one_minus_q : 0;
                sum[lane] += t * t;
            }
        }
        for (int lane = 0; lane < lanes; ++lane) {
            const Real density = (sum[lane] + fluid.solid_density[first + lane]) * fluid.density_scale;
            fluid.density[first + lane] = density;
            fluid.compression[first + lane] = density > 1 ? density - 1 : 0;
        }
    }
}

template <class Real>
void solve_density_constraint(const FluidView<Real>& fluid) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real* const c = fluid.compression;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = 0; block < fluid.blocks; ++block) {
        const int first = block * lanes;
        Real sum_x[lanes] = {}, sum_y[lanes] = {}, sum_z[lanes] = {}, count[lanes] = {};
        for (int row = fluid.row_begin[block]; row < fluid.row_begin[block + 1]; ++row) {
            const std::int32_t* const neighbour = fluid.neighbour + row * lanes;
            for (int lane = 0; lane < lanes; ++lane) {
                const int j = neighbour[lane];
                const Real dx = x[first + lane] - x[j];
                const Real dy = y[first + lane] - y[j];
                const Real dz = z[first + lane] - z[j];
                const Real r2 = dx * dx + dy * dy + dz * dz;
                const Real inverse_r = 1 / square_root(r2 + tiny<Real>);
                const Real one_minus_q = 1 - r2 * inverse_r * inverse_radius;
                const Real t = one_minus_q > 0 ? one_minus_q : 0;
                const Real s = (c[first + lane] + c[j]) * t * inverse_r;
                sum_x[lane] += s * dx;
                sum_y[lane] += s * dy;
                sum_z[lane] += s * dz;
                count[lane] += one_minus_q > 0 ? Real(1) : Real(0);
            }
        }
        for (int lane = 0; lane < lanes; ++lane) {
            const Real scale = fluid.inverse_mass[first + lane] * fluid.radius * Real(0.5);
            fluid.correction[0][first + lane] = scale * sum_x[lane];
            fluid.correction[1][first + lane] = scale * sum_y[lane];
            fluid.correction[2][first + lane] = scale * sum_z[lane];
            fluid.constraint_count[first + lane] = count[lane];
        }
    }
}

template <class Real>
void smooth_velocities(const FluidView<Real>& fluid) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real* const u = fluid.velocity[0];
    const Real* const v = fluid.velocity[1];
    const Real* const w = fluid.velocity[2];
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = 0; block < fluid.blocks; ++block) {
        const int first = block * lanes;
        Real sum_u[lanes] = {}, sum_v[lanes] = {}, sum_w[lanes] = {};
        for (int row = fluid.row_begin[block]; row < fluid.row_begin[block + 1]; ++row) {
            const std::int32_t* const neighbour = fluid.neighbour + row * lanes;
            for (int lane = 0; lane < lanes; ++lane) {
                const int j = neighbour[lane];
                const Real dx = x[first + lane] - x[j];
                const Real dy = y[first + lane] - y[j];
                const Real dz = z[first + lane] - z[j];
                const Real one_minus_q = 1 - square_root(dx * dx + dy * dy + dz * dz) * inverse_radius;
                const Real t = one_minus_q > 0 ? one_minus_q : 0;
                sum_u[lane] += t * t * (u[j] - u[first + lane]);
                sum_v[lane] += t * t * (v[j] - v[first + lane]);
                sum_w[lane] += t * t * (w[j] - w[first + lane]);
            }
        }
        for (int lane = 0; lane < lanes; ++lane) {
            fluid.velocity_change[0][first + lane] = fluid.density_scale * sum_u[lane];
            fluid.velocity_change[1][first + lane] = fluid.density_scale * sum_v[lane];
            fluid.velocity_change[2][first + lane] = fluid.density_scale * sum_w[lane];
        }
    }
}

}  // namespace

template <class Real>
FluidKernels<Real> fluid_kernels() {
    return {&append_neighbours<Real>, &compute_density<Real>, &solve_density_constraint<Real>,
            &smooth_velocities<Real>};
}

template FluidKernels<float> fluid_kernels<float>();
template FluidKernels<double> fluid_kernels<double>();

}  // namespace natator::cpu::NATATOR_ISA
