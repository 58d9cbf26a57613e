#include "immersed.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace natator::lattice {
namespace {

constexpr double min_volume = 1e-3;  ///< of a cube's at rest; crushed or turned inside out it holds no cells
constexpr double overlap = 1.02;     ///< by this cubes that meet overlap, so that rounding leaves no gaps between them
constexpr double spanned = 0.05;     ///< of the greatest eigenvalue, below which neighbours don't span an axis

/// A gradient where neighbours span less than three axes, completed to a motion that is rigid across.
Eigen::Matrix3d completed(Eigen::Matrix3d gradient, const Eigen::Matrix3d& missing, double half) {
    const double lost = missing.trace();
    if (lost < 0.5) return gradient;
    if (lost > 2.5) return half * Eigen::Matrix3d::Identity();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(missing);  // ascending: 0 spanned, 1 missing
    const Eigen::Matrix3d& e = axes.eigenvectors();
    if (lost < 1.5) {
        const Eigen::Vector3d n = (gradient * e.col(0)).cross(gradient * e.col(1)).normalized();
        const double sign = e.col(0).cross(e.col(1)).dot(e.col(2)) > 0 ? 1 : -1;
        return gradient + sign * half * n * e.col(2).transpose();
    }
    // A row of particles: turned by the least angle.
    const Eigen::Vector3d along = (gradient * e.col(0)).normalized();
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(e.col(0), along);
    return gradient + half * turn.toRotationMatrix() * missing;
}

void store(const Eigen::Matrix3d& from, float* to) {
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) to[3 * r + c] = static_cast<float>(from(r, c));
}

/// Of a cube, in cells from the centre of the first one; inside periodic ends.
Eigen::Vector3d middle_of(const Eigen::Vector3d& place, const Box& box) {
    Eigen::Vector3d middle = (place - box.corner) / box.cell - Eigen::Vector3d::Constant(0.5);
    for (int a = 0; a < 3; ++a)
        if (box.faces[a][0] == Face::periodic && box.cells[a] > 1)
            middle[a] -= box.cells[a] * std::floor(middle[a] / box.cells[a]);
    return middle;
}

}  // namespace

std::vector<Cube> cubes_of(const Obstacle& obstacle, const Box& box) {
    std::vector<Cube> cubes;
    const auto add = [&](const Eigen::Vector3d& place, const Eigen::Vector3d& half) {
        Cube& cube = cubes.emplace_back();
        const Eigen::Vector3d middle = middle_of(place, box), reach = (half / box.cell).array() + surface_offset;
        for (int a = 0; a < 3; ++a) {
            cube.x[a] = static_cast<float>(middle[a]);
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

Immersed::Immersed(const std::vector<Eigen::Vector3d>& rest, const std::vector<int>& body,
                   const std::vector<double>& spacing, double reach_in_spacings, double extension)
    : spacing_(spacing), extension_(extension), near_(rest.size()) {
    std::vector<int> order(rest.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(rest[a].x(), a) < std::pair(rest[b].x(), b); });
    for (std::size_t a = 0; a < order.size(); ++a) {
        const double reach = reach_in_spacings * spacing[order[a]], half = spacing[order[a]] / 2;
        for (std::size_t b = a + 1; b < order.size() && rest[order[b]].x() - rest[order[a]].x() < reach; ++b) {
            const int i = order[a], j = order[b];
            if (body[i] != body[j] || (rest[j] - rest[i]).norm() >= reach) continue;
            near_[i].push_back({j, (rest[j] - rest[i]) / half});
            near_[j].push_back({i, (rest[i] - rest[j]) / half});
        }
    }
    for (auto& neighbours : near_) {
        std::sort(neighbours.begin(), neighbours.end(),
                  [](const Neighbour& a, const Neighbour& b) { return a.particle < b.particle; });
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), inverse = sum;
        for (const Neighbour& one : neighbours) sum += one.weight * one.weight.transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(sum);
        Eigen::Matrix3d missing = Eigen::Matrix3d::Zero();
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d e = axes.eigenvectors().col(k);
            const double value = axes.eigenvalues()[k];
            if (value > spanned * axes.eigenvalues()[2] && value > 0)
                inverse += e * e.transpose() / value;
            else
                missing += e * e.transpose();
        }
        for (Neighbour& one : neighbours) one.weight = inverse * one.weight;
        missing_.push_back(missing);
    }
}

std::vector<Cube> Immersed::cubes(const std::vector<Eigen::Vector3d>& places,
                                  const std::vector<Eigen::Vector3d>& velocities, const Box& box, double step) const {
    std::vector<Cube> cubes(near_.size());
    const double per_step = step / box.cell;
    for (std::size_t p = 0; p < near_.size(); ++p) {
        const double spacing = spacing_[p];
        const auto edge = static_cast<float>(overlap + 2 * extension_ * box.cell / spacing);
        Eigen::Matrix3d shape = Eigen::Matrix3d::Zero(), rate = shape;
        for (const Neighbour& one : near_[p]) {
            const Eigen::Vector3d away = places[one.particle] - places[p],
                                  faster = velocities[one.particle] - velocities[p];
            // Entry by entry: by rows of two that do not follow how a product was stored, each waits for its memory.
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) {
                    shape(r, c) += away[r] * one.weight[c];
                    rate(r, c) += faster[r] * one.weight[c];
                }
        }
        shape = completed(shape, missing_[p], spacing / 2) / box.cell;
        const Eigen::Vector3d middle = middle_of(places[p], box);
        Cube& cube = cubes[p];
        const double half = spacing / 2 / box.cell;
        const bool crushed = !(shape.determinant() > min_volume * half * half * half);
        if (!crushed) store(shape.inverse(), cube.to_rest);
        store(rate * per_step, cube.rate);
        for (int a = 0; a < 3; ++a) {
            cube.x[a] = static_cast<float>(middle[a]);
            cube.v[a] = static_cast<float>(velocities[p][a] * per_step);
            cube.reach[a] = crushed ? -1 : static_cast<float>(shape.row(a).cwiseAbs().sum() * edge);
        }
        cube.edge = edge;
    }
    return cubes;
}

std::vector<Eigen::Vector3d> Immersed::impulses(const std::vector<Push>& pushes, const Box& box, double step) const {
    std::vector<Eigen::Vector3d> impulses(near_.size(), Eigen::Vector3d::Zero());
    const double unit = impulse_unit(box, step);
    for (std::size_t p = 0; p < near_.size(); ++p) {
        const Push& push = pushes[p];
        Eigen::Vector3d own = impulses[p] + unit * Eigen::Vector3d(push.j[0], push.j[1], push.j[2]);
        const Eigen::Matrix3d moment =
            unit * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(push.moment);
        for (const Neighbour& one : near_[p]) {
            const Eigen::Vector3d given = moment * one.weight;
            impulses[one.particle] += given;
            own -= given;
        }
        impulses[p] = own;
    }
    return impulses;
}

}  // namespace natator::lattice
