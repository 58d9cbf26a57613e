#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "natator/gait.h"
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
    Eigen::Vector3i count{10, 10, 10};           ///< lattice points along x, y, z
    double spacing = 0.1;                        ///< lattice constant, length
    Eigen::Vector3d origin{0.05, 0.05, 0.05};    ///< first lattice point
    MassGradient gradient = MassGradient::uniform;
    double bottom_mass = 1;                      ///< mass of the lowest layer
    double top_mass = 1;                         ///< mass of the highest layer
    double clearance = 0.085;                    ///< lattice points closer than this to a body particle are left out
    /// Seed of the places off the lattice that scheme `conserving` begins from. In scheme `lattice` of where the body begins in its
    /// cells, up to half a cell from its place along each axis; 0: there.
    int disorder = 20;
};

/// One cross-section of a body: rows of particles in (y, z). Places in it are in half spacings, which are whole numbers.
struct Slice {
    int height = 1;              ///< rows, along y
    int width = 1;               ///< particles along z of the widest row; of `columns` as many as reach as far
    std::vector<int> rows = {};  ///< particles of each row from the lowest up, all odd or all even; empty: `width` each
    int lift = 0;                ///< height of the middle row above the body's axis, half spacings
    /// z of the particles of each row, ascending, half spacings: where they do not fill the row from one side to the other.
    /// Empty: they do, as many to the left as to the right.
    std::vector<std::vector<int>> columns = {};

    int row(int iy) const {
        const auto i = static_cast<std::size_t>(iy);
        return !columns.empty() ? static_cast<int>(columns[i].size()) : rows.empty() ? width : rows[i];
    }
    int y(int iy) const { return 2 * iy - (height - 1) + lift; }  ///< height of a row above the axis, half spacings
    /// Place of a particle of a row along z, from the middle of left and right, half spacings.
    int z(int iy, int iz) const {
        return columns.empty() ? 2 * iz - (row(iy) - 1) : columns[static_cast<std::size_t>(iy)][static_cast<std::size_t>(iz)];
    }
    int particles() const {
        int sum = 0;
        for (int iy = 0; iy < height; ++iy) sum += row(iy);
        return sum;
    }
};

/// Which way muscles bend a body.
enum class Bend { sideways, vertical };

/// What a gait drives by itself: the muscles between two neighbouring slices of muscle_ends() that bend one way.
struct Actuator {
    int gap = 0;  ///< 0 = between the first two of these slices
    Bend bend = Bend::sideways;
};

/// How neighbouring clusters hang together.
enum class Joint {
    slice,  ///< they share all particles of a slice (thesis 2.2)
    line,   ///< they share those particles of a slice that are nearest the line about which it bends (after thesis 4.4)
};

/// A closed surface that moves with a body.
struct Skin {
    std::string file;    ///< name of the file, as the creature gives it
    std::string digest;  ///< digest of the file, 16 hexadecimal digits
    double unit = 1;     ///< scene lengths of one unit of the file
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: which way of the file is forward, up, right
    Eigen::Vector3d origin{0, 0, 0};                     ///< place in the file that is the centre of the last slice
    std::vector<Eigen::Vector3d> vertices;               ///< at rest, from the centre of the last slice, length
    std::vector<Eigen::Vector3i> triangles;              ///< corners go round counter-clockwise seen from outside
    double volume = 0;                                   ///< inside, length^3
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
    std::shared_ptr<const Skin> skin;  ///< the mesh that slices and joints were made of: `mesh` in the JSON; null: none
    Joint joint = Joint::slice;
    /// Ways in which the muscles of each gap between muscle_ends() bend; empty = sideways alone.
    std::vector<std::vector<Bend>> bends;
    double cluster_stiffness = 0.2;    ///< shape-matching stiffness of every cluster, [0, 1]
    std::vector<double> cluster_stiffnesses;  ///< by cluster from the head on; empty = `cluster_stiffness` for all
    double particle_mass = 1.0;        ///< m_s
    double spring_stiffness = 1.0;     ///< stiffness of every muscle spring, [0, 1]
    std::vector<double> spring_stiffnesses;   ///< one for the springs of each gap; empty = `spring_stiffness` for all
    int springs_per_particle = 4;      ///< springs that each connected particle gives (thesis 2.4)
    Eigen::Vector3d rear_centre{0.45, 0.6, 0.6};  ///< start of the centre of the last slice
    /// n: each particle described here is made of n x n x n, on a lattice n times as fine (model_builder.h).
    int refinement = 1;

    const std::vector<int>& muscle_ends() const { return muscle_slices.empty() ? joints : muscle_slices; }
    int gaps() const { return muscle_ends().empty() ? 0 : static_cast<int>(muscle_ends().size()) - 1; }
    bool bends_by(Bend bend, int gap) const {
        if (bends.empty()) return bend == Bend::sideways;
        const std::vector<Bend>& ways = bends[static_cast<std::size_t>(gap)];
        return std::find(ways.begin(), ways.end(), bend) != ways.end();
    }
    /// Whether any muscle bends this way.
    bool bends_by(Bend bend) const {
        for (int gap = 0; gap < gaps(); ++gap)
            if (bends_by(bend, gap)) return true;
        return false;
    }
    /// In the order that a gait has them: those that bend sideways from the head on, then those that bend up and down.
    std::vector<Actuator> actuator_list() const {
        std::vector<Actuator> list;
        for (const Bend bend : {Bend::sideways, Bend::vertical})
            for (int gap = 0; gap < gaps(); ++gap)
                if (bends_by(bend, gap)) list.push_back({gap, bend});
        return list;
    }
    int actuators() const { return static_cast<int>(actuator_list().size()); }
    double stiffness_of_cluster(int cluster) const {
        return cluster_stiffnesses.empty() ? cluster_stiffness : cluster_stiffnesses[static_cast<std::size_t>(cluster)];
    }
    double stiffness_of_springs(int gap) const {
        return spring_stiffnesses.empty() ? spring_stiffness : spring_stiffnesses[static_cast<std::size_t>(gap)];
    }
    /// Head to tail at rest, from the first slice's centre to the last one's.
    double length() const { return (static_cast<double>(slices.size()) - 1) * spacing; }
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
    bool plane_contact = true;       ///< a body particle comes within collision_distance of a plane
    double no_progress_after = 2.0;  ///< s without gain in mean x; 0 = never
};

/// A swimmer beside the one that is evaluated, with a gait of its own.
struct Companion {
    Creature creature;
    Gait gait;
};

/// Something that water and bodies can't enter and that stays where it is: particles of infinite mass.
struct Obstacle {
    enum class Shape { sphere, box, mesh };
    Shape shape = Shape::sphere;
    Eigen::Vector3d centre{0, 0, 0};      ///< length; of a mesh: the middle of its box
    double radius = 0;                    ///< radius of a sphere, length
    Eigen::Vector3d size{0, 0, 0};        ///< edges of a box, length
    std::vector<Eigen::Vector3d> points;  ///< places of a mesh's particles, from the centre, length
    double spacing = 0.075;               ///< distance of its particles, length

    /// Whether a place is within it; of a mesh, as near to one of its particles as any place between eight of them.
    bool holds(const Eigen::Vector3d& place) const;
};

/// A tank without an end: it goes along with its swimmer. Where the swimmer has come `step` on from where it began, the
/// water of that length behind it is taken away, as much is put in front at rest, and all is moved back by `step`.
struct MovingTank {
    bool along_z = false;  ///< aside too, not only along x
    double step = 0.4;     ///< length
    /// Velocity of all the water over ground, length/s, horizontal. Distances are over ground; the tank is the water's.
    Eigen::Vector3d current{0, 0, 0};
};

/// Everything that defines an experiment. What is made without an argument is water of one density, without friction and drag; it
/// needs some, in `fluid` and between `planes`. Scene JSON has thesis_tank() where it says nothing.
struct Scene {
    std::string name;
    std::string description;
    Scheme scheme = Scheme::conserving;
    double duration = 4.0;         ///< s
    double time_step = 1.0 / 60;   ///< one frame, s
    SolverParameters solver;
    std::vector<Plane> planes;
    std::vector<PeriodicAxis> periodic;  ///< axes that have no ends; no planes stand across them
    std::optional<FluidBlock> fluid;
    std::optional<Creature> creature;
    Settling settling;
    Stopping stopping;
    std::optional<MovingTank> moving_tank;
    std::vector<Companion> companions;
    std::vector<Obstacle> obstacles;
    std::vector<Goal> goals;  ///< none: the distance along x

    /// Distance through the water along x, length, of a swimmer that got `distance` (length) along x over ground in
    /// `time` (s).
    double through_water(double distance, double time) const {
        return moving_tank ? distance - time * moving_tank->current.x() : distance;
    }
};

/// The tank of the thesis (2.3) with its water, whose mass falls from 2 at the bottom to 1/14 at the top, without a swimmer: scheme
/// `flex` with the parameters of Appendix A. The named scene thesis/tank is the same.
Scene thesis_tank();

}  // namespace natator
