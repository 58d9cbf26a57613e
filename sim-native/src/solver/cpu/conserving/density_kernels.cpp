// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules: the templates over Real are the
// definition, beside each stands the same for vectors of floats.
// Macklin, Müller: Position Based Fluids (2013), eq. 1-12, with inverse masses w and a constraint that only pushes.
// Density and gradient come from one kernel, (1 - q)^3 with q = r / R: with poly6 for the density, as the paper has it,
// pairs that have come close are pushed apart without the density ever falling, substep after substep.
#include "density_kernels.h"

#include "../particle_groups.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

/// Below this the gradients of a constraint come from neighbours that the kernel ends at, and 1/v may be infinite.
constexpr float least_response = 1e-30f;

/// 1 / v, or 0 where v is too small for it.
template <class Real>
Real finite_inverse(Real v) {
    return v > Real(least_response) ? 1 / v : 0;
}

/// w_i |grad_i C_i|^2 + sum_k w_k |grad_k C_i|^2 of a slot, of the sums over its fluid neighbours.
template <class Real>
Real inverse_response(const DensityView<Real>& fluid, int i, Real gx, Real gy, Real gz, Real square_sum) {
    const Real cx = fluid.gradient_scale * gx + fluid.solid_gradient[0][i];
    const Real cy = fluid.gradient_scale * gy + fluid.solid_gradient[1][i];
    const Real cz = fluid.gradient_scale * gz + fluid.solid_gradient[2][i];
    const Real others = fluid.gradient_scale * fluid.gradient_scale * square_sum + fluid.solid_gradient_square[i];
    return fluid.inverse_mass[i] * (cx * cx + cy * cy + cz * cz) + others;
}

template <class Real>
void compute_lambda(const DensityView<Real>& fluid) {
    const Real* const w = fluid.inverse_mass;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = fluid.first_block; block < fluid.end_block; ++block) {
        const int first = block * lanes;
        Real sum[lanes] = {}, gx[lanes] = {}, gy[lanes] = {}, gz[lanes] = {}, square[lanes] = {};
        for_each_neighbour<Real>(fluid, block, [&](int lane, int j, const Separation<Real>& d) {
            const Real inverse_r = 1 / square_root(d.r2 + tiny<Real>);
            const Real one_minus_q = 1 - d.r2 * inverse_r * inverse_radius;
            const Real t = one_minus_q > 0 ? one_minus_q : 0;
            const Real g = t * t;
            sum[lane] += g * t;
            gx[lane] -= g * inverse_r * d.x;
            gy[lane] -= g * inverse_r * d.y;
            gz[lane] -= g * inverse_r * d.z;
            square[lane] += w[j] * g * g;
        });
        for (int lane = 0; lane < lanes; ++lane) {
            const int i = first + lane;
            const Real above = fluid.kernel_scale * (sum[lane] - fluid.rest_sum) + fluid.solid_density[i];
            fluid.density[i] = 1 + above;
            const Real response =
                finite_inverse(inverse_response(fluid, i, gx[lane], gy[lane], gz[lane], square[lane]));
            const Real lambda = above > 0 ? -above * response : 0;
            fluid.response[i] = response;
            fluid.lambda[i] = lambda;
            fluid.lambda_sum[i] += lambda;
        }
    }
}

/// inverse distance of a pair, kept for solve_density_constraint if there is room.
Floats inverse_distance(const DensityView<float>& fluid, int entry, Floats r2) {
    const Floats inverse_r = 1 / square_root(r2 + tiny<float>);
    if (fluid.inverse_distance) store(fluid.inverse_distance + entry, inverse_r);
    return inverse_r;
}

/// Sums over the fluid neighbours of a group of slots, without gradient_scale: of gradients, and of w gradient^2.
struct GradientSums {
    Floats x{}, y{}, z{}, square{};

    /// A neighbour with inverse mass w at distance d; g is the size of its gradient.
    void add(Floats g, Floats slope, Floats w, Floats dx, Floats dy, Floats dz) {
        x -= slope * dx;
        y -= slope * dy;
        z -= slope * dz;
        square += w * g * g;
    }
};

/// The same for the slots from `first` on.
Floats inverse_response(const DensityView<float>& fluid, int first, const GradientSums& sums) {
    const Floats cx = fluid.gradient_scale * sums.x + load(fluid.solid_gradient[0] + first);
    const Floats cy = fluid.gradient_scale * sums.y + load(fluid.solid_gradient[1] + first);
    const Floats cz = fluid.gradient_scale * sums.z + load(fluid.solid_gradient[2] + first);
    const Floats others =
        fluid.gradient_scale * fluid.gradient_scale * sums.square + load(fluid.solid_gradient_square + first);
    return load(fluid.inverse_mass + first) * square(cx, cy, cz) + others;
}

Floats finite_inverse(Floats v) {
    return v > least_response ? 1 / v : Floats{};
}

void compute_lambda(const DensityView<float>& fluid) {
    const float* const packed = fluid.packed;
    for_each_group(fluid, [&](int first, int row_begin, int row_end, int lane) {
        const Floats x = load(fluid.position[0] + first);
        const Floats y = load(fluid.position[1] + first);
        const Floats z = load(fluid.position[2] + first);
        Floats sum{};
        GradientSums gradients;
        for (int row = row_begin; row < row_end; ++row) {
            const int entry = row * lanes + lane;
            const Floats4 other = gather(packed, fluid.neighbour + entry);
            const Floats dx = x - other.x, dy = y - other.y, dz = z - other.z;
            const Floats r2 = square(dx, dy, dz);
            const Floats inverse_r = inverse_distance(fluid, entry, r2);
            const Floats t = positive_part(1 - r2 * inverse_r * fluid.inverse_radius);
            const Floats g = t * t;
            const Floats slope = g * inverse_r;
            sum += g * t;
            gradients.add(g, slope, other.w, dx, dy, dz);
        }
        const Floats above = fluid.kernel_scale * (sum - fluid.rest_sum) + load(fluid.solid_density + first);
        const Floats response = finite_inverse(inverse_response(fluid, first, gradients));
        const Floats lambda = -positive_part(above) * response;
        store(fluid.density + first, 1 + above);
        store(fluid.response + first, response);
        store(fluid.lambda + first, lambda);
        store(fluid.lambda_sum + first, load(fluid.lambda_sum + first) + lambda);
    });
}

template <class Real>
void solve_density_constraint(const DensityView<Real>& fluid) {
    const Real* const lambda = fluid.lambda;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = fluid.first_block; block < fluid.end_block; ++block) {
        const int first = block * lanes;
        Real sum_x[lanes] = {}, sum_y[lanes] = {}, sum_z[lanes] = {};
        for_each_neighbour<Real>(fluid, block, [&](int lane, int j, const Separation<Real>& d) {
            const Real inverse_r = 1 / square_root(d.r2 + tiny<Real>);
            const Real one_minus_q = 1 - d.r2 * inverse_r * inverse_radius;
            const Real t = one_minus_q > 0 ? one_minus_q : 0;
            const Real s = (lambda[first + lane] + lambda[j]) * t * t * inverse_r;
            sum_x[lane] -= s * d.x;
            sum_y[lane] -= s * d.y;
            sum_z[lane] -= s * d.z;
        });
        for (int lane = 0; lane < lanes; ++lane) {
            const Real scale = fluid.inverse_mass[first + lane] * fluid.gradient_scale;
            fluid.correction[0][first + lane] = scale * sum_x[lane];
            fluid.correction[1][first + lane] = scale * sum_y[lane];
            fluid.correction[2][first + lane] = scale * sum_z[lane];
        }
    }
}

void solve_density_constraint(const DensityView<float>& fluid) {
    const float* const packed = fluid.packed;
    for_each_group(fluid, [&](int first, int row_begin, int row_end, int lane) {
        const Floats x = load(fluid.position[0] + first);
        const Floats y = load(fluid.position[1] + first);
        const Floats z = load(fluid.position[2] + first);
        const Floats lambda = load(fluid.lambda + first);
        Floats sum_x{}, sum_y{}, sum_z{};
        for (int row = row_begin; row < row_end; ++row) {
            const int entry = row * lanes + lane;
            const Floats4 other = gather(packed, fluid.neighbour + entry);
            const Floats dx = x - other.x, dy = y - other.y, dz = z - other.z;
            const Floats r2 = square(dx, dy, dz);
            const Floats inverse_r =
                fluid.inverse_distance ? load(fluid.inverse_distance + entry) : 1 / square_root(r2 + tiny<float>);
            const Floats t = positive_part(1 - r2 * inverse_r * fluid.inverse_radius);
            const Floats s = (lambda + other.w) * t * t * inverse_r;
            sum_x -= s * dx;
            sum_y -= s * dy;
            sum_z -= s * dz;
        }
        const Floats scale = load(fluid.inverse_mass + first) * fluid.gradient_scale;
        store(fluid.correction[0] + first, scale * sum_x);
        store(fluid.correction[1] + first, scale * sum_y);
        store(fluid.correction[2] + first, scale * sum_z);
    });
}

template <class Real>
void compute_rate_lambda(const DensityView<Real>& fluid, Real inverse_h) {
    const Real* const u = fluid.velocity[0];
    const Real* const v = fluid.velocity[1];
    const Real* const w = fluid.velocity[2];
    const Real* const inverse_mass = fluid.inverse_mass;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = fluid.first_block; block < fluid.end_block; ++block) {
        const int first = block * lanes;
        Real rate[lanes] = {}, gx[lanes] = {}, gy[lanes] = {}, gz[lanes] = {}, square[lanes] = {};
        for_each_neighbour<Real>(fluid, block, [&](int lane, int j, const Separation<Real>& d) {
            const int i = first + lane;
            const Real inverse_r = 1 / square_root(d.r2 + tiny<Real>);
            const Real one_minus_q = 1 - d.r2 * inverse_r * inverse_radius;
            const Real t = one_minus_q > 0 ? one_minus_q : 0;
            const Real approach = (u[j] - u[i]) * d.x + (v[j] - v[i]) * d.y + (w[j] - w[i]) * d.z;
            const Real g = t * t;
            const Real s = g * inverse_r;
            rate[lane] += s * approach;
            gx[lane] -= s * d.x;
            gy[lane] -= s * d.y;
            gz[lane] -= s * d.z;
            square[lane] += inverse_mass[j] * g * g;
        });
        for (int lane = 0; lane < lanes; ++lane) {
            const int i = first + lane;
            const Real response =
                finite_inverse(inverse_response(fluid, i, gx[lane], gy[lane], gz[lane], square[lane]));
            const Real lambda = -fluid.gradient_scale * rate[lane] * response;
            const Real most = -fluid.lambda_sum[i] * inverse_h;
            const Real limited = lambda < most ? lambda : most;
            fluid.lambda[i] = most > 0 ? limited : 0;
        }
    }
}

void compute_rate_lambda(const DensityView<float>& fluid, float inverse_h) {
    const float* const packed = fluid.packed;
    const float* const packed_velocity = fluid.packed_velocity;
    for_each_group(fluid, [&](int first, int row_begin, int row_end, int lane) {
        const Floats x = load(fluid.position[0] + first);
        const Floats y = load(fluid.position[1] + first);
        const Floats z = load(fluid.position[2] + first);
        const Floats u = load(fluid.velocity[0] + first);
        const Floats v = load(fluid.velocity[1] + first);
        const Floats w = load(fluid.velocity[2] + first);
        Floats rate{};
        GradientSums gradients;
        for (int row = row_begin; row < row_end; ++row) {
            const int entry = row * lanes + lane;
            const Floats4 other = gather(packed, fluid.neighbour + entry);
            const Floats4 moves = gather(packed_velocity, fluid.neighbour + entry);
            const Floats dx = x - other.x, dy = y - other.y, dz = z - other.z;
            const Floats r2 = square(dx, dy, dz);
            const Floats inverse_r = inverse_distance(fluid, entry, r2);
            const Floats t = positive_part(1 - r2 * inverse_r * fluid.inverse_radius);
            const Floats approach = (moves.x - u) * dx + (moves.y - v) * dy + (moves.z - w) * dz;
            const Floats g = t * t;
            const Floats slope = g * inverse_r;
            rate += slope * approach;
            gradients.add(g, slope, other.w, dx, dy, dz);
        }
        const Floats response = finite_inverse(inverse_response(fluid, first, gradients));
        const Floats lambda = -fluid.gradient_scale * rate * response;
        const Floats most = -load(fluid.lambda_sum + first) * inverse_h;
        const Floats limited = lambda < most ? lambda : most;
        store(fluid.lambda + first, most > 0 ? limited : Floats{});
    });
}

template <class Real>
void smooth_velocities(const DensityView<Real>& fluid) {
    const Real* const u = fluid.velocity[0];
    const Real* const v = fluid.velocity[1];
    const Real* const w = fluid.velocity[2];
    const Real* const inverse_mass = fluid.inverse_mass;
    const Real inverse_radius_square = fluid.inverse_radius * fluid.inverse_radius;
    for (int block = fluid.first_block; block < fluid.end_block; ++block) {
        const int first = block * lanes;
        Real sum_u[lanes] = {}, sum_v[lanes] = {}, sum_w[lanes] = {};
        for_each_neighbour<Real>(fluid, block, [&](int lane, int j, const Separation<Real>& d) {
            const int i = first + lane;
            const Real left = 1 - d.r2 * inverse_radius_square;
            const Real t = left > 0 ? left : 0;
            const Real weights = inverse_mass[i] + inverse_mass[j];
            const Real s = t * t * t * 2 * inverse_mass[i] / (weights + tiny<Real>);
            sum_u[lane] += s * (u[j] - u[i]);
            sum_v[lane] += s * (v[j] - v[i]);
            sum_w[lane] += s * (w[j] - w[i]);
        });
        for (int lane = 0; lane < lanes; ++lane) {
            fluid.velocity_change[0][first + lane] = fluid.kernel_scale * sum_u[lane];
            fluid.velocity_change[1][first + lane] = fluid.kernel_scale * sum_v[lane];
            fluid.velocity_change[2][first + lane] = fluid.kernel_scale * sum_w[lane];
        }
    }
}

void smooth_velocities(const DensityView<float>& fluid) {
    const float* const packed = fluid.packed;
    const float* const packed_velocity = fluid.packed_velocity;
    const float inverse_radius_square = fluid.inverse_radius * fluid.inverse_radius;
    for_each_group(fluid, [&](int first, int row_begin, int row_end, int lane) {
        const Floats x = load(fluid.position[0] + first);
        const Floats y = load(fluid.position[1] + first);
        const Floats z = load(fluid.position[2] + first);
        const Floats u = load(fluid.velocity[0] + first);
        const Floats v = load(fluid.velocity[1] + first);
        const Floats w = load(fluid.velocity[2] + first);
        const Floats inverse_mass = load(fluid.inverse_mass + first);
        Floats sum_u{}, sum_v{}, sum_w{};
        for (int row = row_begin; row < row_end; ++row) {
            const std::int32_t* const neighbour = fluid.neighbour + row * lanes + lane;
            const Floats4 other = gather(packed, neighbour);
            const Floats4 moves = gather(packed_velocity, neighbour);
            const Floats dx = x - other.x, dy = y - other.y, dz = z - other.z;
            const Floats t = positive_part(1 - square(dx, dy, dz) * inverse_radius_square);
            const Floats s = t * t * t * 2 * inverse_mass / (inverse_mass + other.w + tiny<float>);
            sum_u += s * (moves.x - u);
            sum_v += s * (moves.y - v);
            sum_w += s * (moves.z - w);
        }
        store(fluid.velocity_change[0] + first, fluid.kernel_scale * sum_u);
        store(fluid.velocity_change[1] + first, fluid.kernel_scale * sum_v);
        store(fluid.velocity_change[2] + first, fluid.kernel_scale * sum_w);
    });
}

void pack(const DensityView<float>& fluid) {
    pack_arrays(fluid, fluid.position, fluid.inverse_mass, fluid.packed);
}

void pack_lambda(const DensityView<float>& fluid) {
    pack_arrays(fluid, fluid.position, fluid.lambda, fluid.packed);
}

void pack_velocity(const DensityView<float>& fluid) {
    pack_arrays(fluid, fluid.velocity, fluid.inverse_mass, fluid.packed_velocity);
}

/// The plain loops read the arrays as they are.
template <class Real>
void pack_nothing(const DensityView<Real>&) {}

}  // namespace

template <class Real>
DensityKernels<Real> scalar_density_kernels() {
    return {&pack_nothing<Real>,
            &pack_nothing<Real>,
            &pack_nothing<Real>,
            &compute_lambda<Real>,
            &solve_density_constraint<Real>,
            &compute_rate_lambda<Real>,
            &smooth_velocities<Real>};
}

template DensityKernels<float> scalar_density_kernels<float>();
template DensityKernels<double> scalar_density_kernels<double>();

template <>
DensityKernels<double> density_kernels<double>() {
    return scalar_density_kernels<double>();
}

template <>
DensityKernels<float> density_kernels<float>() {
    return {&pack,
            &pack_lambda,
            &pack_velocity,
            &compute_lambda,
            &solve_density_constraint,
            &compute_rate_lambda,
            &smooth_velocities};
}

}  // namespace natator::cpu::NATATOR_ISA
