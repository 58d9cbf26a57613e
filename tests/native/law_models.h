#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "model/cluster.h"
#include "model/disorder_fluid.h"
#include "model/fluid_block.h"
#include "natator/model.h"
#include "natator/scene.h"

/// Models of scheme `conserving` that tests share.
namespace natator::test {

template <class Solver, class Real>
void advance_frames(Solver& solver, const Model& model, State<Real>& state, int frames) {
    for (int k = 0; k < frames; ++k)
        ASSERT_FALSE(solver.update(state, model.time_step, model.parameters.substeps)) << "frame " << k;
}

inline constexpr double water_spacing = 0.1;

/// A box of water with a free surface, walls at 0 and behind the last particles, without friction and damping. `scale`
/// shrinks the particles: 1/2 makes them half as far apart and an eighth as heavy.
inline Model lattice_of_water(const Eigen::Vector3i& count, double scale = 1) {
    Model model;
    model.scheme = Scheme::conserving;
    SolverParameters& p = model.parameters;
    p = thesis_tank().solver;
    for (double* length : {&p.radius, &p.solid_rest_distance, &p.fluid_rest_distance, &p.collision_distance})
        *length *= scale;
    p.substeps = 2;
    p.flex.viscosity = p.damping = p.dynamic_friction = p.particle_friction = 0;
    add_fluid({.count = count,
               .spacing = water_spacing * scale,
               .origin = Eigen::Vector3d::Constant(water_spacing * scale / 2),
               .gradient = MassGradient::uniform,
               .bottom_mass = scale * scale * scale},
              model);
    const Eigen::Vector3d size = water_spacing * scale * count.cast<double>();
    model.planes = {{{0, 1, 0}, 0}, {{1, 0, 0}, 0}, {{-1, 0, 0}, size.x()}, {{0, 0, 1}, 0}, {{0, 0, -1}, size.z()}};
    return model;
}

/// The same, disordered as scenes are; each start otherwise, and start 0 as scenes are.
inline Model box_of_water(const Eigen::Vector3i& count, double scale = 1, int start = 0) {
    Model model = lattice_of_water(count, scale);
    constexpr int seed_of_scenes = 20;
    disorder_fluid(water_spacing * scale, model, seed_of_scenes + start);
    return model;
}

/// A block of water in the corner of a tank without lid, x and z long.
inline Model block_in_tank(const Eigen::Vector3i& count, double x, double z) {
    Model model = box_of_water(count);
    model.planes = {{{0, 1, 0}, 0}, {{1, 0, 0}, 0}, {{-1, 0, 0}, x}, {{0, 0, 1}, 0}, {{0, 0, -1}, z}};
    return model;
}

/// One particle of water, without friction and damping.
inline Model drop_at(const Eigen::Vector3d& place, const Eigen::Vector3d& gravity, const std::vector<Plane>& planes) {
    Model model = lattice_of_water({1, 1, 1});
    model.position = {place};
    model.parameters.gravity = gravity;
    model.planes = planes;
    return model;
}

/// A block of water of which one wall is away.
inline Model collapsing_block() {
    Model model = box_of_water({8, 10, 8});
    model.planes[2].offset += 1;
    return model;
}

/// A cube of water in free space that shears and stretches.
inline Model drop_of_unequal_masses() {
    Model model = box_of_water({6, 6, 6});
    model.planes.clear();
    model.parameters.gravity.setZero();
    for (int i = 0; i < model.particles(); ++i) {
        model.inverse_mass[i] = i % 3 == 0 ? 14 : 0.5;
        model.velocity[i] = Eigen::Vector3d(0, 2 * (model.position[i].x() - 0.3), -(model.position[i].y() - 0.3));
    }
    return model;
}

/// A cube of 0.3 of solid particles on the water's lattice, held together by one stiff cluster, in the middle of a box
/// of water; `density` in units of the water's. The solids come last. `start`: as of box_of_water.
inline Model cube_in_water(double density, double scale, int start = 0) {
    const int width = static_cast<int>(10 / scale), half = static_cast<int>(1.5 / scale), middle = width / 2;
    Model model = box_of_water({width, width, width}, scale, start);
    const double h = water_spacing * scale, low = (middle - half) * h, high = low + 0.3;
    std::vector<Eigen::Vector3d> water;
    for (const Eigen::Vector3d& x : model.position)
        if ((x.array() < low).any() || (x.array() > high).any()) water.push_back(x);
    std::vector<int> cube;
    model.position = water;
    const int side = static_cast<int>(3 / scale);
    for (int k = 0; k < side * side * side; ++k) {
        cube.push_back(model.particles());
        const Eigen::Vector3d place(k % side, k / side % side, k / side / side);
        model.position.push_back(Eigen::Vector3d::Constant(low) + h * (place.array() + 0.5).matrix());
    }
    const double water_inverse_mass = model.inverse_mass.front();
    model.velocity.assign(model.position.size(), Eigen::Vector3d::Zero());
    model.inverse_mass.assign(model.position.size(), water_inverse_mass);
    model.phase.resize(model.position.size());
    for (const int i : cube) {
        model.phase[i] = 1;
        model.inverse_mass[i] /= density;
    }
    model.clusters.push_back(make_cluster(cube, model.position, 1));
    return model;
}

/// A horizontal chain of 11 links of 0.1, let go with its first particle held.
inline Model hanging_chain() {
    Model model;
    model.scheme = Scheme::conserving;
    model.parameters = thesis_tank().solver;
    model.parameters.damping = 0;
    model.parameters.iterations = 64;  // so many that no energy hides in stretched links
    for (int i = 0; i < 12; ++i) {
        model.position.emplace_back(0.1 * i, 2, 0);
        model.velocity.emplace_back(Eigen::Vector3d::Zero());
        model.inverse_mass.push_back(i == 0 ? 0 : 1);
        model.phase.push_back(1u);
        if (i > 0) model.springs.push_back({i - 1, i, 0.1, 1});
    }
    return model;
}

}  // namespace natator::test
