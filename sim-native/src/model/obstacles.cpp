#include "obstacles.h"

#include <algorithm>
#include <cmath>

namespace natator {
namespace {

constexpr std::uint32_t obstacle_phase = phase::group_mask;  // a group that no body has

Eigen::Vector3d half_size(const Obstacle& obstacle) {
    return obstacle.shape == Obstacle::Shape::sphere ? Eigen::Vector3d::Constant(obstacle.radius)
                                                     : Eigen::Vector3d(obstacle.size / 2);
}

/// Lattice points on each side of the centre of a sphere or box.
Eigen::Vector3d points_aside(const Obstacle& obstacle) {
    return (half_size(obstacle) / obstacle.spacing).array().floor();
}

void add_particle(const Eigen::Vector3d& place, Model& model) {
    model.position.push_back(place);
    model.velocity.push_back(Eigen::Vector3d::Zero());
    model.inverse_mass.push_back(0);
    model.phase.push_back(obstacle_phase);
}

}  // namespace

bool Obstacle::holds(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d way = place - centre;
    switch (shape) {
        case Shape::sphere:
            return way.norm() <= radius;
        case Shape::box:
            return (way.cwiseAbs().array() <= size.array() / 2).all();
        case Shape::mesh:
            break;
    }
    const double near = std::sqrt(3) / 2 * spacing;
    return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) { return (way - point).norm() <= near; });
}

double most_particles(const Obstacle& obstacle) {
    if (obstacle.shape == Obstacle::Shape::mesh) return static_cast<double>(obstacle.points.size());
    return (2 * points_aside(obstacle).array() + 1).prod();
}

void add_obstacle(const Obstacle& obstacle, Model& model) {
    for (const Eigen::Vector3d& point : obstacle.points) add_particle(obstacle.centre + point, model);
    if (obstacle.shape == Obstacle::Shape::mesh) return;
    const Eigen::Vector3d aside = points_aside(obstacle);
    for (double x = -aside.x(); x <= aside.x(); ++x)
        for (double y = -aside.y(); y <= aside.y(); ++y)
            for (double z = -aside.z(); z <= aside.z(); ++z) {
                const Eigen::Vector3d place = obstacle.centre + obstacle.spacing * Eigen::Vector3d(x, y, z);
                if (obstacle.holds(place)) add_particle(place, model);
            }
}

}  // namespace natator
