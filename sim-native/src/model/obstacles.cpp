#include "obstacles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace natator {
namespace {

constexpr std::uint32_t obstacle_phase = phase::group_mask;  // a group that no body has
constexpr double rounding = 1e-12;                           // particles on the very surface belong to it, on all sides
constexpr double apart = 0.5;                                // of a spacing: how near particles of two obstacles may be

Eigen::Vector3d half_size(const Obstacle& obstacle) {
    return obstacle.shape == Obstacle::Shape::sphere ? Eigen::Vector3d::Constant(obstacle.radius)
                                                     : Eigen::Vector3d(obstacle.size / 2);
}

/// Lattice points on each side of the centre of a sphere or box.
Eigen::Vector3d points_aside(const Obstacle& obstacle) {
    return (half_size(obstacle) / obstacle.spacing * (1 + rounding)).array().floor();
}

void add_particle(const Eigen::Vector3d& place, Model& model) {
    model.position.push_back(place);
    model.velocity.push_back(Eigen::Vector3d::Zero());
    model.inverse_mass.push_back(0);
    model.phase.push_back(obstacle_phase);
}

/// Calls visit(place) for the particles of an obstacle.
template <class Visit>
void for_each_place(const Obstacle& obstacle, const Visit& visit) {
    for (const Eigen::Vector3d& point : obstacle.points) visit((obstacle.centre + point).eval());
    if (obstacle.shape == Obstacle::Shape::mesh) return;
    const Eigen::Vector3d aside = points_aside(obstacle);
    for (double x = -aside.x(); x <= aside.x(); ++x)
        for (double y = -aside.y(); y <= aside.y(); ++y)
            for (double z = -aside.z(); z <= aside.z(); ++z) {
                const Eigen::Vector3d way = obstacle.spacing * Eigen::Vector3d(x, y, z);
                const bool within =
                    obstacle.shape == Obstacle::Shape::box || way.norm() <= obstacle.radius * (1 + rounding);
                if (within) visit((obstacle.centre + way).eval());
            }
}

/// Places of particles, in cells.
class OccupiedPlaces {
public:
    /// `cell`: the largest distance that is asked for.
    explicit OccupiedPlaces(double cell) : cell_(cell) {}

    void add(const Eigen::Vector3d& place) { places_[cell_of(place)].push_back(place); }

    bool any_nearer(const Eigen::Vector3d& place, double distance) const {
        const Cell middle = cell_of(place);
        for (int around = 0; around < 27; ++around) {
            const auto found =
                places_.find({middle[0] + around % 3 - 1, middle[1] + around / 3 % 3 - 1, middle[2] + around / 9 - 1});
            if (found == places_.end()) continue;
            for (const Eigen::Vector3d& other : found->second)
                if ((other - place).norm() < distance) return true;
        }
        return false;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const Eigen::Vector3d& place) const {
        const Eigen::Array3d at = (place / cell_).array().floor();
        return {static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()),
                static_cast<std::int64_t>(at.z())};
    }

    double cell_;
    std::map<Cell, std::vector<Eigen::Vector3d>> places_;
};

Eigen::AlignedBox3d box_around(const Obstacle& obstacle) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : obstacle.points) box.extend((obstacle.centre + point).eval());
    if (obstacle.shape == Obstacle::Shape::mesh) return box;
    return {obstacle.centre - half_size(obstacle), obstacle.centre + half_size(obstacle)};
}

/// Those that are further than `distance` from all others: most of a scene's.
std::vector<bool> which_are_alone(const std::vector<Obstacle>& obstacles, double distance) {
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(obstacles.size());
    for (const Obstacle& obstacle : obstacles) boxes.push_back(box_around(obstacle));
    std::vector<bool> alone(obstacles.size(), true);
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (boxes[a].exteriorDistance(boxes[b]) <= distance) alone[a] = alone[b] = false;
    return alone;
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
    return std::any_of(points.begin(), points.end(),
                       [&](const Eigen::Vector3d& point) { return (way - point).norm() <= near; });
}

double max_particles(const Obstacle& obstacle) {
    if (obstacle.shape == Obstacle::Shape::mesh) return static_cast<double>(obstacle.points.size());
    return (2 * points_aside(obstacle).array() + 1).prod();
}

std::vector<int> add_obstacles(const std::vector<Obstacle>& obstacles, Model& model) {
    std::vector<int> particles;
    double widest = 0;
    for (const Obstacle& obstacle : obstacles) widest = std::max(widest, obstacle.spacing);
    const std::vector<bool> alone = which_are_alone(obstacles, apart * widest);
    OccupiedPlaces taken(apart * widest);
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
        const std::size_t first = model.position.size();
        for_each_place(obstacles[k], [&](const Eigen::Vector3d& place) {
            if (alone[k] || !taken.any_nearer(place, apart * obstacles[k].spacing)) add_particle(place, model);
        });
        particles.push_back(static_cast<int>(model.position.size() - first));
        if (alone[k]) continue;
        for (std::size_t i = first; i < model.position.size(); ++i) taken.add(model.position[i]);
    }
    return particles;
}

}  // namespace natator
