#pragma once

#include <vector>

#include <Eigen/Dense>

namespace natator::bench {

/// Particles answer to a change of speed only in the next step, with forces that are those of their added mass. Where
/// that is more than the body's own mass, a body that took all of each force at once would swing ever more. Of so much
/// more inertia, which keeps on as it did last, it takes an added mass of up to 1 + 2 times that; a force that lasts
/// acts in full.
inline constexpr double kept_among_particles = 2;
/// No cell of a lattice gives more than it holds, and a body of neutral density weighs as much as its cells.
inline constexpr double kept_on_lattice = 0;

/// A body that bends as it is told to and else moves freely in the plane of x and z, by the forces on it: what its
/// bending alone does to it has neither linear nor angular momentum. All of its particles have mass 1; it neither rises
/// nor tilts.
class FreeMotion {
public:
    /// At rest, at these places. Of each force it takes 1 / (1 + kept), and keeps the rest of what it took last.
    /// Without `turns` no moment turns it.
    explicit FreeMotion(std::vector<Eigen::Vector3d> places, double kept, bool turns = true);

    /// Where its particles are, and with what velocities they go to where they will be in so long, s, if its shape is
    /// `shape` then, in any frame. The same frame must serve all calls.
    const std::vector<Eigen::Vector3d>& places() const { return places_; }
    std::vector<Eigen::Vector3d> set_off(const std::vector<Eigen::Vector3d>& shape, double time);
    /// The same of a body that is led to these places whatever the forces on it.
    std::vector<Eigen::Vector3d> lead(const std::vector<Eigen::Vector3d>& to, double time);
    /// Goes there; `forces` on the particles, mean over the way, change how it moves next.
    void arrive(const std::vector<Eigen::Vector3d>& forces, double time);
    /// From now on it turns so much faster about y than the forces make it, 1/s.
    void steer(double rate) { steering_ = rate; }
    /// Nothing else changes.
    void shift(const Eigen::Vector3d& by);

    Eigen::Vector3d centre() const;
    const Eigen::Vector3d& velocity() const { return velocity_; }
    double angle() const { return angle_; }  ///< by which the shapes' frame is turned about y, from x away from z

private:
    std::vector<Eigen::Vector3d> places_, next_;
    double angle_ = 0;  ///< of that frame about y
    Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), acceleration_ = Eigen::Vector3d::Zero();
    double angular_momentum_ = 0, moment_ = 0;  ///< about the centre, along y
    double steering_ = 0;
    double kept_;
    bool turns_;
};

}  // namespace natator::bench
