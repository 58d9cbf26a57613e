#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "solver/lattice/water.h"

namespace natator::lattice {

inline Box box_of(int x, int y, int z, Face face = Face::periodic) {
    Box box;
    box.cells = {x, y, z};
    for (auto& ends : box.faces) ends[0] = ends[1] = face;
    return box;
}

template <class Work>
void for_each_cell(const Box& box, const Work& work) {
    for (int z = 0; z < box.cells.z(); ++z)
        for (int y = 0; y < box.cells.y(); ++y)
            for (int x = 0; x < box.cells.x(); ++x) work(Eigen::Vector3i(x, y, z));
}

/// A rigid bar of particles, 2 x 2 x 2 cells each and as heavy as their water, in a box without friction along its
/// walls.
struct Bar {
    Bar() {
        for (int x = 0; x < 6; ++x)
            for (int y = 0; y < 2; ++y)
                for (int z = 0; z < 3; ++z) place_.emplace_back(10.3 + 2 * x, 10.2 + 2 * y, 10.1 + 2 * z);
        velocity_.assign(place_.size(), Eigen::Vector3d::Zero());
        body_.emplace(place_, std::vector<int>(place_.size(), 0), std::vector<double>(place_.size(), 2), 1.75, 0);
        box_ = box_of(36, 28, 28, Face::free_slip);
        box_.viscosity = 0.02;
    }
    void begin(const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin) {
        for (std::size_t i = 0; i < place_.size(); ++i) velocity_[i] = velocity + spin.cross(place_[i] - centre());
    }
    Eigen::Vector3d centre() const {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const Eigen::Vector3d& x : place_) sum += x / static_cast<double>(place_.size());
        return sum;
    }
    Eigen::Vector3d momentum_of_bar() const {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const Eigen::Vector3d& v : velocity_) sum += mass * v;
        return sum;
    }
    /// A step; the bar stays rigid.
    void advance(Water& water) {
        std::vector<Push> pushes;
        water.advance(cubes(), 1, pushes);
        move(pushes);
    }
    std::vector<Cube> cubes() const { return body_->cubes(place_, velocity_, box_, 1); }
    void move(const std::vector<Push>& pushes) {
        const std::vector<Eigen::Vector3d> impulse = body_->impulses(pushes, box_, 1);
        const Eigen::Vector3d middle = centre();
        Eigen::Vector3d sum = Eigen::Vector3d::Zero(), turning = sum;
        Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
        for (std::size_t i = 0; i < place_.size(); ++i) {
            const Eigen::Vector3d p = mass * velocity_[i] + impulse[i], arm = place_[i] - middle;
            sum += p;
            turning += arm.cross(p);
            inertia += mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
        }
        const Eigen::Vector3d v = sum / (mass * static_cast<double>(place_.size())), spin = inertia.inverse() * turning;
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(spin.norm(), spin.norm() > 0 ? spin.normalized() : Eigen::Vector3d::UnitX())
                .toRotationMatrix();
        for (std::size_t i = 0; i < place_.size(); ++i) {
            const Eigen::Vector3d arm = turn * (place_[i] - middle);
            place_[i] = middle + v + arm;
            velocity_[i] = v + spin.cross(arm);
        }
    }

    static constexpr double mass = 8;
    std::vector<Eigen::Vector3d> place_, velocity_;
    std::optional<Immersed> body_;
    Box box_;
};

}  // namespace natator::lattice
