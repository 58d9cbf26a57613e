// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules.
// Macklin, Müller: Position Based Fluids (2013), eq. 1-12, with inverse masses w and a constraint that only pushes.
// Density and gradient come from one kernel, (1 - q)^3 with q = r / R: with poly6 for the density, as the paper has it,
// pairs that have come close are pushed apart without the density ever falling, substep after substep.
#include "density_kernels.h"

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
void compute_lambda(const DensityView<Real>& fluid) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real* const w = fluid.inverse_mass;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = 0; block < fluid.blocks; ++block) {
        const int first = block * lanes;
        Real sum[lanes] = {}, gx[lanes] = {}, gy[lanes] = {}, gz[lanes] = {}, square[lanes] = {};
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
                const Real g = t * t;
                sum[lane] += g * t;
                gx[lane] -= g * inverse_r * dx;
                gy[lane] -= g * inverse_r * dy;
                gz[lane] -= g * inverse_r * dz;
                square[lane] += w[j] * g * g;
            }
        }
        for (int lane = 0; lane < lanes; ++lane) {
            const int i = first + lane;
            const Real above = fluid.kernel_scale * (sum[lane] - fluid.rest_sum) + fluid.solid_density[i];
            const Real cx = fluid.gradient_scale * gx[lane] + fluid.solid_gradient[0][i];
            const Real cy = fluid.gradient_scale * gy[lane] + fluid.solid_gradient[1][i];
            const Real cz = fluid.gradient_scale * gz[lane] + fluid.solid_gradient[2][i];
            const Real others =
                fluid.gradient_scale * fluid.gradient_scale * square[lane] + fluid.solid_gradient_square[i];
            const Real all = w[i] * (cx * cx + cy * cy + cz * cz) + others;
            fluid.density[i] = 1 + above;
            const Real response = all > 0 ? 1 / all : 0;
            const Real lambda = above > 0 ? -above * response : 0;
            fluid.response[i] = response;
            fluid.lambda[i] = lambda;
            fluid.lambda_sum[i] += lambda;
        }
    }
}

template <class Real>
void solve_density_constraint(const DensityView<Real>& fluid) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real* const lambda = fluid.lambda;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = 0; block < fluid.blocks; ++block) {
        const int first = block * lanes;
        Real sum_x[lanes] = {}, sum_y[lanes] = {}, sum_z[lanes] = {};
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
                const Real s = (lambda[first + lane] + lambda[j]) * t * t * inverse_r;
                sum_x[lane] -= s * dx;
                sum_y[lane] -= s * dy;
                sum_z[lane] -= s * dz;
            }
        }
        for (int lane = 0; lane < lanes; ++lane) {
            const Real scale = fluid.inverse_mass[first + lane] * fluid.gradient_scale;
            fluid.correction[0][first + lane] = scale * sum_x[lane];
            fluid.correction[1][first + lane] = scale * sum_y[lane];
            fluid.correction[2][first + lane] = scale * sum_z[lane];
        }
    }
}

template <class Real>
void compute_rate_lambda(const DensityView<Real>& fluid, Real inverse_h) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real* const u = fluid.velocity[0];
    const Real* const v = fluid.velocity[1];
    const Real* const w = fluid.velocity[2];
    const Real* const inverse_mass = fluid.inverse_mass;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = 0; block < fluid.blocks; ++block) {
        const int first = block * lanes;
        Real rate[lanes] = {}, gx[lanes] = {}, gy[lanes] = {}, gz[lanes] = {}, square[lanes] = {};
        for (int row = fluid.row_begin[block]; row < fluid.row_begin[block + 1]; ++row) {
            const std::int32_t* const neighbour = fluid.neighbour + row * lanes;
            for (int lane = 0; lane < lanes; ++lane) {
                const int i = first + lane;
                const int j = neighbour[lane];
                const Real dx = x[i] - x[j];
                const Real dy = y[i] - y[j];
                const Real dz = z[i] - z[j];
                const Real r2 = dx * dx + dy * dy + dz * dz;
                const Real inverse_r = 1 / square_root(r2 + tiny<Real>);
                const Real one_minus_q = 1 - r2 * inverse_r * inverse_radius;
                const Real t = one_minus_q > 0 ? one_minus_q : 0;
                const Real approach = (u[j] - u[i]) * dx + (v[j] - v[i]) * dy + (w[j] - w[i]) * dz;
                const Real g = t * t;
                const Real s = g * inverse_r;
                rate[lane] += s * approach;
                gx[lane] -= s * dx;
                gy[lane] -= s * dy;
                gz[lane] -= s * dz;
                square[lane] += inverse_mass[j] * g * g;
            }
        }
        for (int lane = 0; lane < lanes; ++lane) {
            const int i = first + lane;
            const Real cx = fluid.gradient_scale * gx[lane] + fluid.solid_gradient[0][i];
            const Real cy = fluid.gradient_scale * gy[lane] + fluid.solid_gradient[1][i];
            const Real cz = fluid.gradient_scale * gz[lane] + fluid.solid_gradient[2][i];
            const Real others =
                fluid.gradient_scale * fluid.gradient_scale * square[lane] + fluid.solid_gradient_square[i];
            const Real all = inverse_mass[i] * (cx * cx + cy * cy + cz * cz) + others;
            const Real lambda = all > 0 ? -fluid.gradient_scale * rate[lane] / all : 0;
            const Real most = -fluid.lambda_sum[i] * inverse_h;
            const Real limited = lambda < most ? lambda : most;
            fluid.lambda[i] = most > 0 ? limited : 0;
        }
    }
}

template <class Real>
void smooth_velocities(const DensityView<Real>& fluid) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    const Real* const u = fluid.velocity[0];
    const Real* const v = fluid.velocity[1];
    const Real* const w = fluid.velocity[2];
    const Real* const inverse_mass = fluid.inverse_mass;
    const Real inverse_radius_square = fluid.inverse_radius * fluid.inverse_radius;
    for (int block = 0; block < fluid.blocks; ++block) {
        const int first = block * lanes;
        Real sum_u[lanes] = {}, sum_v[lanes] = {}, sum_w[lanes] = {};
        for (int row = fluid.row_begin[block]; row < fluid.row_begin[block + 1]; ++row) {
            const std::int32_t* const neighbour = fluid.neighbour + row * lanes;
            for (int lane = 0; lane < lanes; ++lane) {
                const int i = first + lane;
                const int j = neighbour[lane];
                const Real dx = x[i] - x[j];
                const Real dy = y[i] - y[j];
                const Real dz = z[i] - z[j];
                const Real left = 1 - (dx * dx + dy * dy + dz * dz) * inverse_radius_square;
                const Real t = left > 0 ? left : 0;
                const Real weights = inverse_mass[i] + inverse_mass[j];
                const Real s = t * t * t * 2 * inverse_mass[i] / (weights + tiny<Real>);
                sum_u[lane] += s * (u[j] - u[i]);
                sum_v[lane] += s * (v[j] - v[i]);
                sum_w[lane] += s * (w[j] - w[i]);
            }
        }
        for (int lane = 0; lane < lanes; ++lane) {
            fluid.velocity_change[0][first + lane] = fluid.kernel_scale * sum_u[lane];
            fluid.velocity_change[1][first + lane] = fluid.kernel_scale * sum_v[lane];
            fluid.velocity_change[2][first + lane] = fluid.kernel_scale * sum_w[lane];
        }
    }
}

}  // namespace

template <class Real>
DensityKernels<Real> density_kernels() {
    return {&compute_lambda<Real>, &solve_density_constraint<Real>, &compute_rate_lambda<Real>,
            &smooth_velocities<Real>};
}

template DensityKernels<float> density_kernels<float>();
template DensityKernels<double> density_kernels<double>();

}  // namespace natator::cpu::NATATOR_ISA
