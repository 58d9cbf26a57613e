#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "box.h"
#include "physics/vec3.h"

namespace natator::lattice {

/// Cells by which bodies are larger than their outlines on each side. Water sticks to the centres of their outer cells,
/// which lie up to a cell inside. A slowly spinning sphere 12 cells across has 0.88, 0.92, 0.99 and 1.01 of its
/// torque with 0, 0.1, 0.2 and 0.4. The thrust of a plate 2 cells thick along which a wave goes is 0.050, 0.034 and
/// 0.019 with 0, 0.1 and 0.2; with cells a third as wide 0.042, 0.036 and 0.032 (tests/native/lattice_water_test.cpp).
constexpr double surface_offset = 0.1;

/// A particle as the water sees it: a cube of body that moves, turns and is stretched with its neighbours. Lengths in
/// cells from the centre of the first one, times in steps. xi: from its middle at rest, half spacings, so that the cube
/// is -1 <= xi <= 1.
struct Cube {
    float x[3], v[3];
    float to_rest[9];  ///< rows: xi of a distance from x, half spacings/cell
    float rate[9];     ///< rows: velocity by xi, cells/step a half spacing
    float reach[3];    ///< half of the box around it, cells
    float edge;        ///< it has the cells whose |xi| is at most this
    int round;         ///< 1: it is the ball of the xi whose square is at most `edge`; else 0
};

/// What stands in the water, as cubes that do not move: a sphere or a box is one, a mesh has one for each of its
/// points.
std::vector<Cube> cubes_of(const Obstacle& obstacle, const Box& box);

/// What the water gave a cube in a step, cells/step times cells' masses, and its moments: rows J, columns xi.
struct Push {
    double j[3] = {}, moment[9] = {};
};

/// Mass length/s that is 1 in a Push, in a step of so long, s.
double impulse_unit(const Box& box, double step);

/// A neighbour of a particle at rest.
struct NearAtRest {
    int particle;
    physics::Vec3<double> weight;  ///< of its distance or velocity in the gradient by xi
};

/// A particle at rest.
struct CubeAtRest {
    double half = 0;                  ///< of its spacing, length
    int begin = 0, end = 0;           ///< its neighbours, in the order of their numbers
    int missing = 0;                  ///< axes that they do not span
    physics::Vec3<double> axis[3]{};  ///< of space; the missing ones are the last
};

/// Bodies of particles in water. Each particle's cube follows its neighbours at rest by moving least squares, so that a
/// body's affine motions are exact; what pushes its cells is given to it and them by the transposed weights, which keep
/// momentum.
class Immersed {
public:
    /// `rest`: places at rest, length; of particles of the same `body`, which have the same `spacing`, those nearer
    /// than `reach` spacings are neighbours. 1.75: those of faces and edges, with which soft bodies are stable; 1.2:
    /// those of faces alone, for bodies of given shape. `extension`: cells by which the body is larger on each side
    /// than its cubes, since water sticks to the centres of its outer cells.
    Immersed(const std::vector<Eigen::Vector3d>& rest, const std::vector<int>& body, const std::vector<double>& spacing,
             double reach, double extension);

    int particles() const { return static_cast<int>(rest_.size()); }
    const std::vector<CubeAtRest>& rest() const { return rest_; }
    const std::vector<NearAtRest>& near() const { return near_; }
    double extension() const { return extension_; }
    /// At these places, length, with these velocities, length/s, in a step of so long, s.
    std::vector<Cube> cubes(const std::vector<Eigen::Vector3d>& places, const std::vector<Eigen::Vector3d>& velocities,
                            const Box& box, double step) const;
    /// By particle, mass length/s, of what a step of so long, s, gave the cubes; those behind are not of these.
    std::vector<Eigen::Vector3d> impulses(const std::vector<Push>& pushes, const Box& box, double step) const;

private:
    double extension_;
    std::vector<CubeAtRest> rest_;
    std::vector<NearAtRest> near_;  ///< one particle's behind the other's
};

}  // namespace natator::lattice
