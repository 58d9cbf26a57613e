#include "immersed.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "body_cubes.h"

namespace natator::lattice {
namespace {

constexpr double spanned = 0.05;  ///< of the greatest eigenvalue, below which neighbours don't span an axis

physics::Vec3<double> to_vec3(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

std::vector<Cube> cubes_of(const Obstacle& obstacle, const Box& box) {
    std::vector<Cube> cubes;
    const CubeBox within = cube_box(box, surface_offset);
    const auto add = [&](const Eigen::Vector3d& place, const Eigen::Vector3d& half) {
        Cube& cube = cubes.emplace_back();
        const Eigen::Vector3d reach = (half / box.cell).array() + surface_offset;
        middle_of(to_vec3(place), within, cube.x);
        for (int a = 0; a < 3; ++a) {
            cube.to_rest[4 * a] = static_cast<float>(1 / reach[a]);
            cube.reach[a] = static_cast<float>(reach[a]);
        }
        cube.edge = 1;
        cube.round = obstacle.shape == Obstacle::Shape::sphere ? 1 : 0;
    };
    if (obstacle.shape == Obstacle::Shape::sphere)
        add(obstacle.centre, Eigen::Vector3d::Constant(obstacle.radius));
    else if (obstacle.shape == Obstacle::Shape::box)
        add(obstacle.centre, obstacle.size / 2);
    else
        for (const Eigen::Vector3d& point : obstacle.points)
            add(obstacle.centre + point, Eigen::Vector3d::Constant(obstacle.spacing / 2));
    return cubes;
}

double impulse_unit(const Box& box, double step) {
    return box.cell_mass() * box.cell / step;
}

CubeBox cube_box(const Box& box, double extension) {
    CubeBox made{box.cell, to_vec3(box.corner), {}, extension};
    for (int a = 0; a < 3; ++a)
        made.around[a] = box.faces[a][0] == Face::periodic && box.cells[a] > 1 ? box.cells[a] : 0;
    return made;
}

Immersed::Immersed(const std::vector<Eigen::Vector3d>& rest, const std::vector<int>& body,
                   const std::vector<double>& spacing, double reach_in_spacings, double extension)
    : extension_(extension) {
    std::vector<std::vector<std::pair<int, Eigen::Vector3d>>> near(rest.size());  // and where, half spacings
    std::vector<int> order(rest.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(rest[a].x(), a) < std::pair(rest[b].x(), b); });
    for (std::size_t a = 0; a < order.size(); ++a) {
        const double reach = reach_in_spacings * spacing[order[a]], half = spacing[order[a]] / 2;
        for (std::size_t b = a + 1; b < order.size() && rest[order[b]].x() - rest[order[a]].x() < reach; ++b) {
            const int i = order[a], j = order[b];
            if (body[i] != body[j] || (rest[j] - rest[i]).norm() >= reach) continue;
            near[i].emplace_back(j, (rest[j] - rest[i]) / half);
            near[j].emplace_back(i, (rest[i] - rest[j]) / half);
        }
    }
    for (std::size_t p = 0; p < rest.size(); ++p) {
        std::sort(near[p].begin(), near[p].end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), inverse = sum;
        for (const auto& [other, at] : near[p]) sum += at * at.transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(sum);  // ascending
        CubeAtRest& own = rest_.emplace_back();
        own.half = spacing[p] / 2;
        own.begin = static_cast<int>(near_.size());
        for (int k = 2; k >= 0; --k) {
            const Eigen::Vector3d e = axes.eigenvectors().col(k);
            const double value = axes.eigenvalues()[k];
            own.axis[2 - k] = to_vec3(e);
            if (value > spanned * axes.eigenvalues()[2] && value > 0)
                inverse += e * e.transpose() / value;
            else
                ++own.missing;
        }
        for (const auto& [other, at] : near[p]) near_.push_back({other, to_vec3(inverse * at)});
        own.end = static_cast<int>(near_.size());
    }
}

std::vector<Cube> Immersed::cubes(const std::vector<Eigen::Vector3d>& places,
                                  const std::vector<Eigen::Vector3d>& velocities, const Box& box, double step) const {
    std::vector<Cube> cubes(rest_.size());
    const CubeBox within = cube_box(box, extension_);
    const auto of = [](const std::vector<Eigen::Vector3d>& all) {
        return [&all](int particle) { return to_vec3(all[particle]); };
    };
    for (int p = 0; p < particles(); ++p)
        cubes[p] = cube_of(rest_[p], near_.data(), p, of(places), of(velocities), within, step);
    return cubes;
}

std::vector<Eigen::Vector3d> Immersed::impulses(const std::vector<Push>& pushes, const Box& box, double step) const {
    std::vector<Eigen::Vector3d> impulses(rest_.size(), Eigen::Vector3d::Zero());
    const double unit = impulse_unit(box, step);
    for (std::size_t p = 0; p < rest_.size(); ++p) {
        const Push& push = pushes[p];
        Eigen::Vector3d own = impulses[p] + unit * Eigen::Vector3d(push.j[0], push.j[1], push.j[2]);
        const Eigen::Matrix3d moment =
            unit * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(push.moment);
        for (int k = rest_[p].begin; k < rest_[p].end; ++k) {
            const auto& [other, weight] = near_[k];
            const Eigen::Vector3d given = moment * Eigen::Vector3d(weight.x, weight.y, weight.z);
            impulses[other] += given;
            own -= given;
        }
        impulses[p] = own;
    }
    return impulses;
}

}  // namespace natator::lattice
