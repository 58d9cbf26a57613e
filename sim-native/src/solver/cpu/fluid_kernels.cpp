// Compiled once per instruction set: NATATOR_ISA names the namespace, the compiler's flags choose the instructions.
// A block of 16 particles is worked on lane by lane, each lane with its own sums. The templates over Real are the
// definition, and what double runs; beside each stands the same for vectors of floats, which changes the order of no
// sum. Include nothing here that has inline functions with linkage.
#include "fluid_kernels.h"
#include "particle_groups.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

template <class Real>
void compute_density(const FluidView<Real>& fluid) {
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = fluid.first_block; block < fluid.end_block; ++block) {
        const int first = block * lanes;
        Real sum[lanes] = {};
        for_each_neighbour<Real>(fluid, block, [&](int lane, int, const Separation<Real>& d) {
            const Real one_minus_q = 1 - square_root(d.r2) * inverse_radius;
            const Real t = one_minus_q > 0 ? one_minus_q : 0;
            sum[lane] += t * t;
        });
        for (int lane = 0; lane < lanes; ++lane) {
            const Real density = (sum[lane] + fluid.solid_density[first + lane]) * fluid.density_scale;
            fluid.density[first + lane] = density;
            fluid.compression[first + lane] = density > 1 ? density - 1 : 0;
        }
    }
}

void pack(const FluidView<float>& fluid) {
    pack_arrays(fluid, fluid.position, fluid.compression, fluid.packed);
}

void pack_velocity(const FluidView<float>& fluid) {
    pack_arrays(fluid, fluid.velocity, fluid.compression, fluid.packed_velocity);
}

/// The plain loops read the arrays as they are.
template <class Real>
void pack_nothing(const FluidView<Real>&) {}

/// keep_distances: also keeps each pair's distance for solve_density_constraint.
template <bool keep_distances>
void density_by_vectors(const FluidView<float>& fluid) {
    const std::int32_t* const neighbours = fluid.neighbour;
    const float* const packed = fluid.packed;
    float* const distance = fluid.distance;
    const float inverse_radius = fluid.inverse_radius;
    for_each_group(fluid, [&](int first, int row_begin, int row_end, int lane) {
        const Floats x = load(fluid.position[0] + first);
        const Floats y = load(fluid.position[1] + first);
        const Floats z = load(fluid.position[2] + first);
        Floats sum{};
        for (int row = row_begin; row < row_end; ++row) {
            const int entry = row * lanes + lane;
            const Floats4 other = gather(packed, neighbours + entry);
            const Floats dx = x - other.x, dy = y - other.y, dz = z - other.z;
            const Floats r = square_root(square(dx, dy, dz) + tiny<float>);
            if constexpr (keep_distances) store(distance + entry, r);
            sum += positive_square(1 - r * inverse_radius);
        }
        const Floats density = (sum + load(fluid.solid_density + first)) * fluid.density_scale;
        store(fluid.density + first, density);
        store(fluid.compression + first, positive_part(density - 1));
    });
}

template <class Real>
void solve_density_constraint(const FluidView<Real>& fluid) {
    const Real* const c = fluid.compression;
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = fluid.first_block; block < fluid.end_block; ++block) {
        const int first = block * lanes;
        Real sum_x[lanes] = {}, sum_y[lanes] = {}, sum_z[lanes] = {}, count[lanes] = {};
        for_each_neighbour<Real>(fluid, block, [&](int lane, int j, const Separation<Real>& d) {
            const Real inverse_r = 1 / square_root(d.r2 + tiny<Real>);
            const Real one_minus_q = 1 - d.r2 * inverse_r * inverse_radius;
            const Real t = one_minus_q > 0 ? one_minus_q : 0;
            const Real s = (c[first + lane] + c[j]) * t * inverse_r;
            sum_x[lane] += s * d.x;
            sum_y[lane] += s * d.y;
            sum_z[lane] += s * d.z;
            count[lane] += one_minus_q > 0 ? Real(1) : Real(0);
        });
        for (int lane = 0; lane < lanes; ++lane) {
            const Real scale = fluid.inverse_mass[first + lane] * fluid.radius * Real(0.5);
            fluid.correction[0][first + lane] = scale * sum_x[lane];
            fluid.correction[1][first + lane] = scale * sum_y[lane];
            fluid.correction[2][first + lane] = scale * sum_z[lane];
            fluid.constraint_count[first + lane] = count[lane];
        }
    }
}

void compute_density(const FluidView<float>& fluid) {
    fluid.distance ? density_by_vectors<true>(fluid) : density_by_vectors<false>(fluid);
}

/// At the positions, and with the distances if they were kept, that compute_density has left.
template <bool kept_distances>
void density_constraint_by_vectors(const FluidView<float>& fluid) {
    const std::int32_t* const neighbours = fluid.neighbour;
    const float* const packed = fluid.packed;
    const float* const distance = fluid.distance;
    const float inverse_radius = fluid.inverse_radius;
    for_each_group(fluid, [&](int first, int row_begin, int row_end, int lane) {
        const Floats x = load(fluid.position[0] + first);
        const Floats y = load(fluid.position[1] + first);
        const Floats z = load(fluid.position[2] + first);
        const Floats c = load(fluid.compression + first);
        Floats sum_x{}, sum_y{}, sum_z{}, count{};
        for (int row = row_begin; row < row_end; ++row) {
            const int entry = row * lanes + lane;
            const Floats4 other = gather(packed, neighbours + entry);
            const Floats dx = x - other.x, dy = y - other.y, dz = z - other.z;
            const Floats r2 = square(dx, dy, dz);
            Floats r;
            if constexpr (kept_distances)
                r = load(distance + entry);
            else
                r = square_root(r2 + tiny<float>);
            const Floats inverse_r = 1 / r;
            const Floats t = positive_part(1 - r2 * inverse_r * inverse_radius);
            const Floats s = (c + other.w) * t * inverse_r;
            sum_x += s * dx;
            sum_y += s * dy;
            sum_z += s * dz;
            count = count_positive(count, t);
        }
        const Floats scale = load(fluid.inverse_mass + first) * fluid.radius * 0.5f;
        store(fluid.correction[0] + first, scale * sum_x);
        store(fluid.correction[1] + first, scale * sum_y);
        store(fluid.correction[2] + first, scale * sum_z);
        store(fluid.constraint_count + first, count);
    });
}

void solve_density_constraint(const FluidView<float>& fluid) {
    fluid.distance ? density_constraint_by_vectors<true>(fluid) : density_constraint_by_vectors<false>(fluid);
}

template <class Real>
void smooth_velocities(const FluidView<Real>& fluid) {
    const Real* const u = fluid.velocity[0];
    const Real* const v = fluid.velocity[1];
    const Real* const w = fluid.velocity[2];
    const Real inverse_radius = fluid.inverse_radius;
    for (int block = fluid.first_block; block < fluid.end_block; ++block) {
        const int first = block * lanes;
        Real sum_u[lanes] = {}, sum_v[lanes] = {}, sum_w[lanes] = {};
        for_each_neighbour<Real>(fluid, block, [&](int lane, int j, const Separation<Real>& d) {
            const Real one_minus_q = 1 - square_root(d.r2) * inverse_radius;
            const Real t = one_minus_q > 0 ? one_minus_q : 0;
            sum_u[lane] += t * t * (u[j] - u[first + lane]);
            sum_v[lane] += t * t * (v[j] - v[first + lane]);
            sum_w[lane] += t * t * (w[j] - w[first + lane]);
        });
        for (int lane = 0; lane < lanes; ++lane) {
            fluid.velocity_change[0][first + lane] = fluid.density_scale * sum_u[lane];
            fluid.velocity_change[1][first + lane] = fluid.density_scale * sum_v[lane];
            fluid.velocity_change[2][first + lane] = fluid.density_scale * sum_w[lane];
        }
    }
}

void smooth_velocities(const FluidView<float>& fluid) {
    const std::int32_t* const neighbours = fluid.neighbour;
    const float* const packed = fluid.packed;
    const float* const packed_velocity = fluid.packed_velocity;
    const float inverse_radius = fluid.inverse_radius;
    for_each_group(fluid, [&](int first, int row_begin, int row_end, int lane) {
        const Floats x = load(fluid.position[0] + first);
        const Floats y = load(fluid.position[1] + first);
        const Floats z = load(fluid.position[2] + first);
        const Floats u = load(fluid.velocity[0] + first);
        const Floats v = load(fluid.velocity[1] + first);
        const Floats w = load(fluid.velocity[2] + first);
        Floats sum_u{}, sum_v{}, sum_w{};
        for (int row = row_begin; row < row_end; ++row) {
            const std::int32_t* const neighbour = neighbours + row * lanes + lane;
            const Floats4 other = gather(packed, neighbour);
            const Floats4 moves = gather(packed_velocity, neighbour);
            const Floats dx = x - other.x, dy = y - other.y, dz = z - other.z;
            const Floats t2 = positive_square(1 - square_root(square(dx, dy, dz)) * inverse_radius);
            sum_u += t2 * (moves.x - u);
            sum_v += t2 * (moves.y - v);
            sum_w += t2 * (moves.z - w);
        }
        store(fluid.velocity_change[0] + first, fluid.density_scale * sum_u);
        store(fluid.velocity_change[1] + first, fluid.density_scale * sum_v);
        store(fluid.velocity_change[2] + first, fluid.density_scale * sum_w);
    });
}

}  // namespace

template <class Real>
FluidKernels<Real> scalar_fluid_kernels() {
    return {&pack_nothing<Real>, &pack_nothing<Real>, &compute_density<Real>, &solve_density_constraint<Real>,
            &smooth_velocities<Real>};
}

template FluidKernels<float> scalar_fluid_kernels<float>();
template FluidKernels<double> scalar_fluid_kernels<double>();

template <>
FluidKernels<double> fluid_kernels<double>() {
    return scalar_fluid_kernels<double>();
}

template <>
FluidKernels<float> fluid_kernels<float>() {
    return {&pack, &pack_velocity, &compute_density, &solve_density_constraint, &smooth_velocities};
}

}  // namespace natator::cpu::NATATOR_ISA
