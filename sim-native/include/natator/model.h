#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "natator/gait.h"
#include "natator/parameters.h"
#include "natator/water_box.h"

namespace natator {

/// Bits of a particle's phase: a group number and flags, as NVIDIA Flex packs them.
namespace phase {
inline constexpr std::uint32_t group_mask = 0x000fffff;
inline constexpr std::uint32_t self_collide = 1u << 20;         ///< collides with particles of its own group
inline constexpr std::uint32_t self_collide_filter = 1u << 21;  ///< but not with those near it at rest
inline constexpr std::uint32_t fluid = 1u << 22;                ///< takes part in the density constraint
}  // namespace phase

/// Distance constraint between two particles.
struct Spring {
    int a = 0;
    int b = 0;
    double rest_length = 0;  ///< length
    double stiffness = 1;    ///< [0, 1]
};

/// Shape-matching constraint: particles that keep the shape they have at rest.
struct Cluster {
    std::vector<int> particles;
    std::vector<Eigen::Vector3d> rest_offset;  ///< rest position minus plain mean of the rest positions, per particle
    double stiffness = 0.2;                    ///< [0, 1]
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< first guess of the rotation fit
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();              ///< first value of the stored centre
};

/// A spring that an actuator drives: rest length l = l_rest (1 + 1/2 z_m a u), thesis (2.7) and (2.8).
struct Muscle {
    int spring = 0;
    int actuator = 0;       ///< in the order of Creature::actuator_list; those of companions follow
    double lateral = 0;     ///< z_m in [-1, 1], -1 = left edge, +1 = right edge; of one that bends up and down, lower and upper
};

/// Which particles make up the swimmer. Slice 0 is the head.
struct Body {
    std::vector<int> particles;
    std::vector<std::vector<int>> slices;
    double length = 0;  ///< head to tail at rest, length
    double spacing = 0;  ///< of its particles at rest, length
};

/// A swimmer beside the one that is evaluated.
struct CompanionBody {
    Body body;
    Gait gait;
    int first_actuator = 0;  ///< first actuator of its muscles, after the body's and earlier companions'
};

/// All that stays constant while a scene runs. One Model serves any number of States, and of threads as long as none changes it.
/// Per-particle vectors have the length of `position`.
struct Model {
    Scheme scheme = Scheme::conserving;
    SolverParameters parameters;
    double time_step = 1.0 / 60;  ///< one frame, s

    std::vector<Eigen::Vector3d> position;  ///< at the start
    std::vector<Eigen::Vector3d> velocity;  ///< at the start
    std::vector<double> inverse_mass;       ///< 0 = held in place
    std::vector<std::uint32_t> phase;
    std::vector<Eigen::Vector3d> rest_position;  ///< for self_collide_filter; empty if no particle has it

    std::vector<Plane> planes;
    std::optional<WaterBox> water_box;    ///< the water of scheme `lattice`, if any; in the others it is particles
    std::vector<PeriodicAxis> periodic;  ///< at most one an axis; all planes are along them
    std::vector<Spring> springs;
    std::vector<Cluster> clusters;
    std::vector<Muscle> muscles;
    int actuators = 0;  ///< number of the body's actuators; a gait has as many
    Body body;
    std::vector<CompanionBody> companions;

    int particles() const { return static_cast<int>(position.size()); }
    bool is_fluid(int i) const { return (phase[i] & natator::phase::fluid) != 0; }
};

}  // namespace natator
