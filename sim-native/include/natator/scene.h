#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "natator/goal.h"
#include "natator/parameters.h"

namespace natator {

/// How the mass of fluid particles depends on their initial height y.
enum class MassGradient {
    uniform,              ///< every particle has the mass `bottom`
    mass_linear,          ///< mass linear in y from `bottom` to `top`
    inverse_mass_linear,  ///< 1/mass linear in y from 1/`bottom` to 1/`top`
};

/// A block of fluid particles on a cubic lattice (thesis 2.3).
struct FluidBlock {
    Eigen::Vector3i count{50, 7, 17};            ///< lattice points along x, y, z
    double spacing = 0.09;                       ///< lattice constant, length
    Eigen::Vector3d origin{0.05, 0.05, 0.05};    ///< first lattice point
    MassGradient gradient = MassGradient::mass_linear;
    double bottom_mass = 2.0;                    ///< mass of the lowest layer
    double top_mass = 1.0 / 14.0;                ///< mass of the highest layer
    double clearance = 0.15;                     ///< lattice points closer than this to a body particle are left out
    int disorder = 20;                           ///< seed of the places off the lattice that scheme `conserving` begins from
};

/// One cross-section of a body: rows of particles in (y, z), all in the middle of the body's left and right.
struct Slice {
    int height = 1;              ///< rows, along y
    int width = 1;               ///< particles along z of the widest row
    std::vector<int> rows = {};  ///< particles of each row from the lowest up, all odd or all even; empty: `width` each

    int row(int iy) const { return rows.empty() ? width : rows[static_cast<std::size_t>(iy)]; }
    int particles() const { return rows.empty() ? height * width : std::accumulate(rows.begin(), rows.end(), 0); }
};

/// A soft body of slices along x (thesis 2.2). Slice 0 is the head; the head faces +x, the top +y, the right side +z.
struct Creature {
    std::string name;
    std::string description;
    std::vector<Slice> slices;
    std::vector<int> joints;           ///< indices of the slices shared by neighbouring clusters, ascending
    std::vector<int> muscle_slices;    ///< slices that muscles run between, ascending; empty = the joints (thesis 2.4)
    double spacing = 0.075;            ///< distance of neighbouring particles at rest, length
    bool of_profile = false;           ///< whether slices and joints were made of curves: `profile` in the JSON
    double cluster_stiffness = 0.2;    ///< shape-matching stiffness of every cluster, [0, 1]
    std::vector<double> cluster_stiffnesses;  ///< of each cluster from the head on; empty = `cluster_stiffness` for all
    double particle_mass = 1.0;        ///< m_s
    double spring_stiffness = 1.0;     ///< stiffness of every muscle spring, [0, 1]
    std::vector<double> spring_stiffnesses;   ///< of each actuator's springs; empty = `spring_stiffness` for all
    int springs_per_particle = 4;      ///< springs that each connected particle gives (thesis 2.4)
    Eigen::Vector3d rear_centre{0.45, 0.6, 0.6};  ///< start of the centre of the last slice
    /// n: each particle described here is made of n x n x n, on a lattice n times as fine (model_builder.h).
    int refinement = 1;

    const std::vector<int>& muscle_ends() const { return muscle_slices.empty() ? joints : muscle_slices; }
    int actuators() const { return muscle_ends().empty() ? 0 : static_cast<int>(muscle_ends().size()) - 1; }
    double stiffness_of_cluster(int cluster) const {
        return cluster_stiffnesses.empty() ? cluster_stiffness : cluster_stiffnesses[static_cast<std::size_t>(cluster)];
    }
    double stiffness_of_springs(int actuator) const {
        return spring_stiffnesses.empty() ? spring_stiffness : spring_stiffnesses[static_cast<std::size_t>(actuator)];
    }
    /// Particles that one described here is made of.
    int parts() const { return refinement * refinement * refinement; }
};

/// Brings the initial block to rest before time 0 (thesis 2.3): short updates, velocities zeroed after each.
struct Settling {
    int updates = 100;
    double time_step = 1e-4;  ///< s
    int substeps = 1;
};

/// When an evaluation ends before its duration (thesis 2.6).
struct Stopping {
    bool plane_contact = true;       ///< a body particle comes within collisionDistance of a plane
    double no_progress_after = 2.0;  ///< s without gain in mean x; 0 = never
};

/// A tank without an end: it goes along with its swimmer. Where the swimmer has come `step` on from where it began, the
/// water of that length behind it is taken away, as much is put in front at rest, and all is moved back by `step`.
struct MovingTank {
    bool along_z = false;  ///< aside too, not only along x
    double step = 0.4;     ///< length
    /// Velocity of all the water over ground, length/s, horizontal. Distances are over ground; the tank is the water's.
    Eigen::Vector3d current{0, 0, 0};
};

/// Everything that defines an experiment, as read from scene JSON.
struct Scene {
    std::string name;
    std::string description;
    Scheme scheme = Scheme::flex;
    double duration = 4.0;         ///< s
    double time_step = 1.0 / 60;   ///< one frame, s
    SolverParameters solver;
    std::vector<Plane> planes;
    std::optional<FluidBlock> fluid;
    std::optional<Creature> creature;
    Settling settling;
    Stopping stopping;
    std::optional<MovingTank> moving_tank;
    std::vector<Goal> goals;  ///< none: the distance along x

    /// Of a way over ground that took so many seconds, what was swum through the water along x, length.
    double through_water(double distance, double time) const {
        return moving_tank ? distance - time * moving_tank->current.x() : distance;
    }
};

}  // namespace natator
