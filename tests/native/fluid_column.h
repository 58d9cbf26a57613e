#pragma once

#include "natator/model.h"

/// What the tests of the laws share, on the CPU and on a GPU: their models.
namespace natator::test {

inline constexpr double frame = 1.0 / 60;

/// A block of fluid of scheme `conserving` in a box that it fills but for the top: the thesis' lattice and parameters
/// without friction. `scale` shrinks the particles: 1/2 gives eight in the place of one, of an eighth of its mass.
inline Model fluid_column(int width, int layers, int substeps, int iterations, double scale = 1) {
    const double spacing = 0.09 * scale, margin = 0.05 * scale;
    Model model;
    model.scheme = Scheme::conserving;
    SolverParameters& p = model.parameters;
    for (double* length : {&p.radius, &p.solidRestDistance, &p.fluidRestDistance, &p.collisionDistance})
        *length *= scale;
    p.substeps = substeps;
    p.numIterations = iterations;
    p.dynamicFriction = 0;
    for (int y = 0; y < layers; ++y)
        for (int x = 0; x < width; ++x)
            for (int z = 0; z < width; ++z)
                model.position.emplace_back(margin + x * spacing, margin + y * spacing, margin + z * spacing);
    model.velocity.assign(model.position.size(), Eigen::Vector3d::Zero());
    model.inverse_mass.assign(model.position.size(), 1 / (scale * scale * scale));
    model.phase.assign(model.position.size(), phase::fluid | phase::self_collide);
    const double side = (width - 1) * spacing + 2 * margin;
    model.planes = {{{0, 1, 0}, 0}, {{1, 0, 0}, 0}, {{0, 0, 1}, 0}, {{-1, 0, 0}, side}, {{0, 0, -1}, side}};
    return model;
}

/// The same with one wall away, and no damping.
inline Model collapsing_block() {
    Model model = fluid_column(8, 10, 4, 4);
    for (Plane& plane : model.planes)
        if (plane.normal.x() < 0) plane.offset += 1;
    model.parameters.damping = 0;
    return model;
}

/// A cube of fluid in free space that shears and stretches.
inline Model drop_of_unequal_masses() {
    Model model = fluid_column(6, 6, 4, 4);
    model.planes.clear();
    model.parameters.gravity.setZero();
    model.parameters.damping = 0;
    for (int i = 0; i < model.particles(); ++i) {
        model.inverse_mass[i] = i % 3 == 0 ? 14 : 0.5;
        model.velocity[i] = Eigen::Vector3d(0, 2 * (model.position[i].x() - 0.3), -(model.position[i].y() - 0.3));
    }
    return model;
}

/// A horizontal chain of 11 links of 0.1, let go with its first particle held.
inline Model hanging_chain() {
    Model model;
    model.scheme = Scheme::conserving;
    model.parameters.damping = 0;
    model.parameters.numIterations = 64;  // so many that no energy hides in stretched links
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
