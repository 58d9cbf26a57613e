#pragma once

#include <cmath>

#include "immersed.h"

// How particles become cubes, on the host and on devices. Lengths in cells, times in steps.
namespace natator::lattice {

using physics::Vec3;

/// The box as cubes see it.
struct CubeBox {
    double cell;
    Vec3<double> corner;
    int around[3];     ///< cells from a periodic end to the other; 0: there are none
    double extension;  ///< see Immersed
};

/// Of a box, for bodies that are so many cells larger on each side.
CubeBox cube_box(const Box& box, double extension);

constexpr double overlap = 1.02;     ///< by this cubes that meet overlap, so that rounding leaves no gaps between them
constexpr double min_volume = 1e-3;  ///< of a cube's at rest; crushed or turned inside out it holds no cells

/// What a particle is pushed by, where the last impulse counts `kept` and the present one 1.
template <class Vector>
NATATOR_HD Vector running_mean(const Vector& given, double kept, const Vector& last) {
    return (given + kept * last) / (1 + kept);
}

/// Rows.
struct Matrix3 {
    Vec3<double> row[3];
};

NATATOR_HD Vec3<double> product(const Matrix3& m, const Vec3<double>& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
/// Adds u v^T.
NATATOR_HD void add_outer(Matrix3& m, const Vec3<double>& u, const Vec3<double>& v) {
    m.row[0] += u.x * v;
    m.row[1] += u.y * v;
    m.row[2] += u.z * v;
}
NATATOR_HD Vec3<double> direction(const Vec3<double>& v) {
    const double square = dot(v, v);
    return square > 0 ? (1 / physics::square_root(square)) * v : v;
}

/// A gradient, length by xi, where neighbours span less than three axes, completed to a motion that is rigid across.
NATATOR_HD void complete(Matrix3& gradient, const CubeAtRest& rest) {
    const Vec3<double>* const e = rest.axis;
    if (rest.missing == 3) {
        gradient = {{{rest.half, 0, 0}, {0, rest.half, 0}, {0, 0, rest.half}}};
    } else if (rest.missing == 1) {
        const Vec3<double> normal = direction(cross(product(gradient, e[0]), product(gradient, e[1])));
        add_outer(gradient, (dot(cross(e[0], e[1]), e[2]) > 0 ? rest.half : -rest.half) * normal, e[2]);
    } else if (rest.missing == 2) {
        // A row of particles: the others are turned by the least angle (Rodrigues' formula).
        const Vec3<double> along = direction(product(gradient, e[0])), turn = cross(e[0], along);
        const double cosine = dot(e[0], along);
        for (const Vec3<double>& across : {e[1], e[2]}) {
            const Vec3<double> turned =
                cosine > -1 + 1e-12 ? cosine * across + cross(turn, across) + (dot(turn, across) / (1 + cosine)) * turn
                                    : -1.0 * across;
            add_outer(gradient, rest.half * turned, across);
        }
    }
}

/// Where a place is in cells from the centre of the first one; inside periodic ends.
NATATOR_HD void middle_of(const Vec3<double>& place, const CubeBox& box, float (&to)[3]) {
    const double from_corner[3] = {place.x - box.corner.x, place.y - box.corner.y, place.z - box.corner.z};
    for (int a = 0; a < 3; ++a) {
        double middle = from_corner[a] / box.cell - 0.5;
        if (box.around[a] > 0) middle -= box.around[a] * floor(middle / box.around[a]);
        to[a] = static_cast<float>(middle);
    }
}

/// `place` and `velocity` give those of a particle, length and length/s; in a step of so long, s.
template <class Places, class Velocities>
NATATOR_HD Cube cube_of(const CubeAtRest& rest, const NearAtRest* near, int particle, const Places& place,
                        const Velocities& velocity, const CubeBox& box, double step) {
    const Vec3<double> x = place(particle), v = velocity(particle);
    Matrix3 shape{}, rate{};
#if defined(__CUDA_ARCH__)
#pragma unroll 4
#endif
    for (int k = rest.begin; k < rest.end; ++k) {
        const NearAtRest& other = near[k];
        add_outer(shape, place(other.particle) - x, other.weight);
        add_outer(rate, velocity(other.particle) - v, other.weight);
    }
    complete(shape, rest);
    const double per_step = step / box.cell, half = rest.half / box.cell;
    Cube cube{};
    cube.edge = static_cast<float>(overlap + box.extension / half);
    middle_of(x, box, cube.x);
    const double of_velocity[3] = {v.x, v.y, v.z};
    for (Vec3<double>& row : shape.row) row = {row.x / box.cell, row.y / box.cell, row.z / box.cell};
    const Vec3<double>*const s = shape.row, across = cross(s[1], s[2]);
    const double volume = dot(s[0], across);
    const bool crushed = !(volume > min_volume * half * half * half);
    const Vec3<double> columns[3] = {across, cross(s[2], s[0]), cross(s[0], s[1])};  // of the inverse, times the volume
    for (int a = 0; a < 3; ++a) {
        cube.v[a] = static_cast<float>(of_velocity[a] * per_step);
        const double of_rate[3] = {rate.row[a].x, rate.row[a].y, rate.row[a].z};
        for (int b = 0; b < 3; ++b) cube.rate[3 * a + b] = static_cast<float>(of_rate[b] * per_step);
        cube.reach[a] = crushed ? -1 : static_cast<float>((fabs(s[a].x) + fabs(s[a].y) + fabs(s[a].z)) * cube.edge);
        if (crushed) continue;
        cube.to_rest[a] = static_cast<float>(columns[a].x / volume);
        cube.to_rest[3 + a] = static_cast<float>(columns[a].y / volume);
        cube.to_rest[6 + a] = static_cast<float>(columns[a].z / volume);
    }
    return cube;
}

}  // namespace natator::lattice
