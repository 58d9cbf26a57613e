#include "water/lattice_swim.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace natator::bench {
namespace {

/// Where the body's middle is in the box, and how far it goes until the box is moved along, of its length.
constexpr double middle = 2.0 / 3, far = 0.05;
constexpr double tail_speed = 1.2;  ///< lengths/beat
/// cells^2/step: a cell that is told its velocity has it to half of what a step's force gives, which puts walls half of
/// this off, in cells.
constexpr double max_viscosity = 0.1;

}  // namespace

LatticeSwim::LatticeSwim(const Swimmer& swimmer, const SwimScene& scene, int resolution, double mach,
                         std::optional<int> gpu) {
    const double cell = scene.length / resolution;
    const auto odd = [&](double lengths) {
        return 2 * static_cast<int>(lengths * resolution / 2) + 1;
    };  // the midline is on centres
    box_.cells = {swimmer.endless ? resolution : static_cast<int>(std::lround(scene.box.x() * resolution)),
                  swimmer.slab ? 1 : odd(scene.box.y()), odd(scene.box.z())};
    box_.cell = cell;
    box_.density = 1 / (cell * cell * cell);
    box_.viscosity = swimmer.viscosity * scene.length * scene.length / scene.beat;
    for (const int axis : {0, 1, 2})
        for (lattice::Face& face : box_.faces[axis])
            face = (swimmer.slab && axis == 1) || (swimmer.endless && axis == 0) ? lattice::Face::periodic
                                                                                 : lattice::Face::free_slip;
    const double by_speed = mach / std::numbers::sqrt3 * cell / (tail_speed * scene.length / scene.beat);
    step_ = scene.beat / std::ceil(scene.beat / std::min(by_speed, max_viscosity * cell * cell / box_.viscosity));
    water_ = gpu ? lattice::Water::on_gpu(box_, *gpu) : lattice::Water::on_cpu(box_, 1);

    const Eigen::Vector3i at(static_cast<int>(middle * box_.cells.x() + 0.5 * resolution), box_.cells.y() / 2,
                             box_.cells.z() / 2);
    const Eigen::Vector3d nose = cell * (at.cast<double>() + Eigen::Vector3d::Constant(0.5));
    std::vector<Eigen::Vector3d> places;
    for (int x = 0; x <= resolution; ++x) {
        const double s = static_cast<double>(x) / resolution;
        const bool even = std::lround(2 * (swimmer.half_width.at(s) * resolution + lattice::surface_offset)) % 2 ==
                          0;  // rows across, not less than one
        for (int y = -at.y(); y <= at.y(); ++y)
            for (int z = -at.z(); z <= at.z(); ++z) {
                const Eigen::Vector3d place(-scene.length * s, cell * y, cell * (even ? z + 0.5 : z));
                if (swimmer.holds(place, scene.length, 0, lattice::surface_offset * cell))
                    places.push_back(nose + place);
            }
    }
    for (const Eigen::Vector3d& place : places)
        normals_.push_back(swimmer.normal(place - nose, scene.length, lattice::surface_offset * cell));
    immersed_.emplace(places, std::vector<int>(places.size(), 0), std::vector<double>(places.size(), cell), 1.2, 0);
    body_.emplace(swimmer, scene, nose, std::move(places), step_, kept_on_lattice);
    run_.particles = box_.cells.prod();
}

bool LatticeSwim::frame() {
    const auto begin = std::chrono::steady_clock::now();
    body_->begin_frame();
    const std::vector<Eigen::Vector3d>& velocities = body_->set_off(step_);
    const std::vector<lattice::Cube> cubes = immersed_->cubes(body_->places(), velocities, box_, step_);
    water_->advance(cubes, step_, pushes_);
    std::vector<Eigen::Vector3d> forces = immersed_->impulses(pushes_, box_, step_);
    for (Eigen::Vector3d& force : forces) force /= step_;
    for (std::size_t i = 0; i < forces.size() && !run_.instability; ++i)
        if (!forces[i].allFinite()) run_.instability = Instability{static_cast<int>(i), "lattice", body_->time()};
    if (run_.instability) return false;
    pressure_ = 0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
        using Rows = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
        const Eigen::Vector3d normal =
            (Eigen::Map<const Rows>(cubes[i].to_rest).transpose().cast<double>() * normals_[i]).stableNormalized();
        pressure_ += normal.dot(forces[i]) * normal.x();
    }
    body_->arrive(forces, step_);
    const bool stays = box_.faces[0][0] == lattice::Face::periodic;
    if (const double by = body_->end_frame(box_.cell, stays ? std::numeric_limits<double>::infinity() : far); by != 0)
        water_->shift({static_cast<int>(std::lround(by / box_.cell)), 0, 0});
    run_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return true;
}

}  // namespace natator::bench
