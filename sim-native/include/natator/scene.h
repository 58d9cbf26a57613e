#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "natator/gait.h"

namespace natator {

/// Which update rule advances the particles.
enum class Scheme {
    flex,  ///< behaves as NVIDIA Flex 1.2.0 was measured to behave
    /// incompressible water (divergence-free SPH) and solids by mass splitting; pair forces equal and opposite
    conserving,
    lattice,  ///< submerged: water on a lattice (cumulant lattice Boltzmann), solids as in conserving
};

/// How the summed corrections of one iteration are scaled before they are applied.
enum class RelaxationMode {
    global = 0,  ///< x += omega * sum
    local = 1,   ///< x += min(1, (1 + omega) / n) * sum, n = number of constraints on the particle
};

/// What scheme `flex` alone has, under the names of NVIDIA Flex; from Appendix A of the thesis.
struct FlexParameters {
    double viscosity = 8.0;                                 ///< smoothing of the fluid's velocities, 1/s, >= 0
    double solidPressure = 0.1;                             ///< weight of solid particles in the fluid's density, >= 0
    RelaxationMode relaxationMode = RelaxationMode::local;  ///< how corrections of one particle are put together
    int maxNeighborsPerParticle = 96;  ///< fluid neighbours kept per particle, the first found in cell order
};

/// Used by scheme `conserving`; by `lattice` too, except the kernel and the pressure.
struct ConservingParameters {
    /// Times that contacts, springs, clusters and planes are solved in each iteration, >= 1. A body's stiffness and the
    /// strength of its muscles need many more iterations than the pressure of the water, and cheaper ones.
    int solid_iterations = 16;
    int max_iterations = 100;  ///< in a substep, with a density_tolerance, >= 1
    /// Iterations go on beyond `iterations`, as far as to max_iterations, until the mean of what the fluid's density
    /// would exceed its target by is at most this, in rest densities; 0: there are `iterations` (Residuals::density).
    double density_tolerance = 0;
    double kinematic_viscosity = 0.0;  ///< of the water, length^2/s, >= 0
    double kernel_support = 2.5;       ///< kernel radius, rest distances of the fluid, [2, 4]
    /// The weight of water that is deeper than the iterations hold up is carried by a hydrostatic pressure, so that it
    /// needs no more substeps. For a tank that stays full: its surface must stay above that level.
    bool modified_pressure = false;
};

/// Parameters of the solver: those that the schemes share, and those of one. What is made without an argument is water
/// without friction and drag; thesis_tank().solver has the values of Appendix A of the thesis. Scene JSON has them all
/// in one object, under the names of NVIDIA Flex: `max_speed` is `maxSpeed` there, `iterations` `numIterations`. Units
/// are those of the scene (length, second, mass); the ranges (sim-native/protocol/scenes.md) are checked when a scene
/// is read and in build_model, in a Model that a program makes those of `kernel_support` and of radius /
/// fluid_rest_distance alone.
struct SolverParameters {
    int substeps = 4;                 ///< substeps per frame, >= 1
    int iterations = 4;               ///< constraint iterations per substep, >= 1
    FlexParameters flex;              ///< of scheme `flex`
    ConservingParameters conserving;  ///< of schemes `conserving` and `lattice`

    Eigen::Vector3d gravity{0, -10, 0};  ///< acceleration, length/s^2
    double radius = 0.15;                ///< interaction radius R of particles, length, > 0
    double solid_rest_distance = 0.075;  ///< distance held between a solid and any other particle, 0 < d <= radius
    double fluid_rest_distance = 0.10;   ///< spacing of the fluid at rest density, 0 < d < radius

    double dynamic_friction = 0.0;   ///< Coulomb coefficient against planes; > 0 also switches particle friction on
    double static_friction = 0.0;    ///< static Coulomb coefficient, planes and particles
    double particle_friction = 0.0;  ///< dynamic Coulomb coefficient between particles
    double restitution = 0.0;        ///< rebound speed over impact speed at planes, [0, 1]
    double adhesion = 0.0;           ///< pull, length/s^2, that a particle touching a plane withstands, >= 0
    double sleep_threshold = 0.0;    ///< a particle slower than this, length/s, stays where it is, >= 0

    double max_speed = std::numeric_limits<float>::max();  ///< limit of |v|, length/s
    /// Limit of |dv|/h, length/s^2. Scheme `flex`: of every particle's change of velocity in a substep. Scheme
    /// `conserving`: of how fast particles are pushed apart that overlapped at the substep's start.
    double max_acceleration = 100.0;
    /// Contacts take a particle's mass times exp(-k height), height against gravity, so that stacks settle faster;
    /// momentum is not kept then. k, 1/length, >= 0.
    double shock_propagation = 0.0;
    /// Damping per contact, 1/s, >= 0. Scheme `flex`: of the velocity, from the second contact on, as a single contact
    /// was measured not to damp. Scheme `conserving`: of the relative velocity in each contact, which keeps momentum.
    double dissipation = 0.0;
    double damping = 0.0;  ///< drag on the velocity, 1/s

    /// Pull between fluid particles beyond fluid_rest_distance, push within it; dimensionless, >= 0. At contact the
    /// push moves a particle by cohesion * radius: in scheme `flex` per iteration before relaxation, as measured; in
    /// scheme `conserving` as a force, per (1/240 s)^2.
    double cohesion = 0.0;
    double surface_tension = 0.0;        ///< pull that evens out the surface's curvature, length/s^2, >= 0
    double vorticity_confinement = 0.0;  ///< strengthens vortices: acceleration per vorticity, length/s, >= 0
    double free_surface_drag = 0.0;      ///< drag times the part of the rest density that a particle lacks, 1/s, >= 0
    double buoyancy = 1.0;               ///< factor on gravity for fluid particles

    double collision_distance = 0.05;        ///< distance held from planes, length
    double particle_collision_margin = 0.0;  ///< added to radius when pairs are found, length
    double shape_collision_margin = 0.0;     ///< added to collision_distance when plane contacts are found, length

    /// omega, >= 0. Scheme `flex`: see RelaxationMode; 0 is the plain mean of a particle's corrections in local mode,
    /// and none of them in global mode. Scheme `conserving`: a factor on every correction, 0 switches the constraints
    /// off.
    double relaxation_factor = 1.0;
};

/// Half space a*x + b*y + c*z + d >= 0 that particles are kept in; (a, b, c) has length 1.
struct Plane {
    Eigen::Vector3d normal{0, 1, 0};  ///< (a, b, c), into the half space
    double offset = 0;                ///< d

    /// Signed distance of a point, positive inside.
    double distance(const Eigen::Vector3d& point) const { return normal.dot(point) + offset; }
};

/// An axis along which the tank closes up with itself: water that leaves at one end comes in at the other, and what is
/// near one end is next to what is near the other. Water is wrapped; bodies are where they have come to, beyond the
/// ends too, and the water meets them as many lengths of the tank back. Not in scheme `flex`.
struct PeriodicAxis {
    int axis = 0;     ///< 0 = x, 2 = z
    double low = 0;   ///< where the lower end is, length
    double high = 0;  ///< where the upper end is, length

    double length() const { return high - low; }  ///< of the tank
};

/// What a swimmer is asked to do; its score is the larger the better.
struct Goal {
    /// What its score is made of.
    enum class Measure {
        distance,  ///< way along x over ground, length
        forward,   ///< way along the own heading (Course::forward), length
        turn,      ///< heading `amount` degrees from that at the start, from +x towards +z; arrives
        depth,     ///< `amount` above the height at the start, length, below if negative; arrives
        reach,     ///< at `place` over ground, from where the body's centre was at the start; arrives
        hold,      ///< stay: 1 / (1 + d/L), d the mean distance from the start over ground, L the body's length
        economy,   ///< way along x per muscle work and body mass, s^2/length: one over the cost of transport
    };
    Measure measure = Measure::distance;  ///< what is asked for
    double weight = 1;                    ///< of its score in the fitness
    double amount = 0;                    ///< of turn, degrees, and depth, length
    Eigen::Vector3d place{0, 0, 0};       ///< of reach, length
    /// How near counts as arrived: degrees for turn, else length.
    double within = 0;
    bool stop = true;  ///< arriving ends the run

    /// A goal that is arrived at. Its score is 1 - r(T)/r(0) for one that did not, r being what is left to go, and
    /// 1 + (1 - t/T) for one that came within `within` at time t of the scene's duration T.
    bool arrives() const { return measure == Measure::turn || measure == Measure::depth || measure == Measure::reach; }
};

/// Name in scenes and results: "distance", "forward", "turn", "depth", "reach", "hold", "economy".
const char* to_string(Goal::Measure measure);

/// What became of a goal.
struct GoalResult {
    Goal::Measure measure = Goal::Measure::distance;  ///< what was asked for
    double weight = 1;                                ///< of the score in the fitness
    double score = 0;                                 ///< see Goal; in units of the measure where it is not arrived at
    std::optional<double> left;                       ///< at the end, of one that is arrived at: degrees or length
    std::optional<double> arrived_at;                 ///< s
};

/// How the mass of fluid particles depends on their initial height y.
enum class MassGradient {
    uniform,              ///< every particle has the mass `bottom`
    mass_linear,          ///< mass linear in y from `bottom` to `top`
    inverse_mass_linear,  ///< 1/mass linear in y from 1/`bottom` to 1/`top`
};

/// A block of fluid particles on a cubic lattice (thesis 2.3).
struct FluidBlock {
    Eigen::Vector3i count{10, 10, 10};              ///< lattice points along x, y, z
    double spacing = 0.1;                           ///< lattice constant, length
    Eigen::Vector3d origin{0.05, 0.05, 0.05};       ///< first lattice point
    MassGradient gradient = MassGradient::uniform;  ///< of masses from bottom to top
    double bottom_mass = 1;                         ///< mass of the lowest layer
    double top_mass = 1;                            ///< mass of the highest layer
    double clearance = 0.085;                       ///< lattice points closer than this to a body particle are left out
    /// Seed of the places off the lattice that scheme `conserving` begins from. In scheme `lattice` of where the body
    /// begins in its cells, up to half a cell from its place along each axis; 0: there.
    int disorder = 20;
    /// Scheme `lattice`: velocity over ground with which all water begins, and comes in at the ends across it,
    /// length/s, horizontal. Obstacles and walls stand in it, and bodies begin at rest.
    Eigen::Vector3d current{0, 0, 0};
    /// Scheme `lattice`: Smagorinsky's constant, for the viscosity of eddies smaller than cells; 0: none is added.
    double smagorinsky = 0;
};

/// One cross-section of a body: rows of particles in (y, z). Places in it are in half spacings, which are whole
/// numbers.
struct Slice {
    int height = 1;              ///< rows, along y
    int width = 1;               ///< particles along z of the widest row; of `columns` as many as reach as far
    std::vector<int> rows = {};  ///< particles of each row from the lowest up, all odd or all even; empty: `width` each
    int lift = 0;                ///< height of the middle row above the body's axis, half spacings
    /// z of the particles of each row, ascending, half spacings: where they do not fill the row from one side to the
    /// other. Empty: they do, as many to the left as to the right.
    std::vector<std::vector<int>> columns = {};

    int row(int iy) const {  ///< number of particles of a row
        const auto i = static_cast<std::size_t>(iy);
        return !columns.empty() ? static_cast<int>(columns[i].size()) : rows.empty() ? width : rows[i];
    }
    int y(int iy) const { return 2 * iy - (height - 1) + lift; }  ///< height of a row above the axis, half spacings
    /// Place of a particle of a row along z, from the middle of left and right, half spacings.
    int z(int iy, int iz) const {
        return columns.empty() ? 2 * iz - (row(iy) - 1)
                               : columns[static_cast<std::size_t>(iy)][static_cast<std::size_t>(iz)];
    }
    int particles() const {  ///< number of them in the slice
        int sum = 0;
        for (int iy = 0; iy < height; ++iy) sum += row(iy);
        return sum;
    }
};

/// Which way muscles bend a body; `contract`: all of an actuator shorten and lengthen together (Regions alone).
enum class Bend { sideways, vertical, contract };

/// What a gait drives by itself: the muscles between two neighbouring slices of muscle_ends(), or Regions, that bend
/// one way.
struct Actuator {
    int gap = 0;                 ///< 0 = between the first two of these slices, or regions
    Bend bend = Bend::sideways;  ///< which way
};

/// How neighbouring clusters hang together.
enum class Joint {
    slice,  ///< they share all particles of a slice (thesis 2.2)
    line,   ///< they share those particles of a slice that are nearest the line about which it bends (after thesis 4.4)
};

/// A closed surface that moves with a body.
struct Skin {
    std::string file;                                    ///< name of the file, as the creature gives it
    std::string digest;                                  ///< digest of the file, 16 hexadecimal digits
    double unit = 1;                                     ///< scene lengths of one unit of the file
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: which way of the file is forward, up, right
    Eigen::Vector3d origin{0, 0, 0};                     ///< place in the file that is the centre of the last slice
    std::vector<Eigen::Vector3d> vertices;               ///< at rest, from the centre of the last slice, length
    std::vector<Eigen::Vector3i> triangles;              ///< corners go round counter-clockwise seen from outside
    double volume = 0;                                   ///< inside, length^3
};

/// How a vertex of a skin follows the body: by `share` as one cluster moves, by the rest as another one does.
struct SkinWeight {
    int cluster = 0;   ///< the first one
    int other = 0;     ///< the other one
    double share = 1;  ///< (0, 1]
};

/// Muscle springs between two particles.
struct Fibre {
    int front = 0;       ///< particle of the body as it is described, by slice from the head, then y, then z
    int rear = 0;        ///< a later one
    int actuator = 0;    ///< that drives it
    double lateral = 0;  ///< as in Muscle
};

/// Clusters around control points, and the muscles between neighbouring ones (model/mesh/regions.h).
struct Regions {
    std::vector<std::vector<int>> clusters;  ///< particles of each, as in Fibre
    std::vector<Actuator> actuators;         ///< in the order that a gait has them
    std::vector<double> places;              ///< where each actuator is along the body, 0 = nose, 1 = tail
    std::vector<Fibre> fibres;               ///< by actuator, front, rear
    std::vector<SkinWeight> skin;            ///< of each vertex of the body's Skin
};

/// A soft body of slices along x (thesis 2.2). Slice 0 is the head; the head faces +x, the top +y, the right side +z.
struct Creature {
    std::string name;                  ///< as it is looked up by
    std::string description;           ///< for people
    std::vector<Slice> slices;         ///< from the head on
    std::vector<int> joints;           ///< indices of the slices shared by neighbouring clusters, ascending
    std::vector<int> muscle_slices;    ///< slices that muscles run between, ascending; empty = the joints (thesis 2.4)
    double spacing = 0.075;            ///< distance of neighbouring particles at rest, length
    bool of_profile = false;           ///< whether slices and joints were made of curves: `profile` in the JSON
    std::shared_ptr<const Skin> skin;  ///< the mesh that slices and joints were made of: `mesh` in the JSON; null: none
    /// Clusters and muscles around control points: `mesh.points` in the JSON; null: clusters are between joints.
    std::shared_ptr<const Regions> regions;
    Joint joint = Joint::slice;  ///< of all neighbouring clusters
    /// Ways in which the muscles of each gap between muscle_ends() bend; empty = sideways alone.
    std::vector<std::vector<Bend>> bends;
    double cluster_stiffness = 0.2;           ///< shape-matching stiffness of every cluster, [0, 1]
    std::vector<double> cluster_stiffnesses;  ///< by cluster from the head on; empty = `cluster_stiffness` for all
    double particle_mass = 1.0;               ///< m_s
    double spring_stiffness = 1.0;            ///< stiffness of every muscle spring, [0, 1]
    std::vector<double> spring_stiffnesses;   ///< one for the springs of each gap; empty = `spring_stiffness` for all
    int springs_per_particle = 4;             ///< springs that each connected particle gives (thesis 2.4)
    Eigen::Vector3d rear_centre{0.45, 0.6, 0.6};  ///< start of the centre of the last slice
    /// n: each particle described here is made of n x n x n, on a lattice n times as fine (build_model).
    int refinement = 1;

    /// Slices that muscles run between.
    const std::vector<int>& muscle_ends() const { return muscle_slices.empty() ? joints : muscle_slices; }
    /// Number of gaps between them, each with muscles.
    int gaps() const { return muscle_ends().empty() ? 0 : static_cast<int>(muscle_ends().size()) - 1; }
    /// Whether muscles of a gap bend this way.
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
    /// In the order that a gait has them: those that bend sideways from the head on, then those that bend up and down,
    /// then those that contract.
    std::vector<Actuator> actuator_list() const {
        if (regions) return regions->actuators;
        std::vector<Actuator> list;
        for (const Bend bend : {Bend::sideways, Bend::vertical})
            for (int gap = 0; gap < gaps(); ++gap)
                if (bends_by(bend, gap)) list.push_back({gap, bend});
        return list;
    }
    int actuators() const { return static_cast<int>(actuator_list().size()); }  ///< number of values of a gait
    double stiffness_of_cluster(int cluster) const {                            ///< [0, 1]
        return cluster_stiffnesses.empty() ? cluster_stiffness : cluster_stiffnesses[static_cast<std::size_t>(cluster)];
    }
    double stiffness_of_springs(int gap) const {  ///< [0, 1]
        return spring_stiffnesses.empty() ? spring_stiffness : spring_stiffnesses[static_cast<std::size_t>(gap)];
    }
    /// Head to tail at rest, from the first slice's centre to the last one's.
    double length() const { return (static_cast<double>(slices.size()) - 1) * spacing; }
    /// Particles that one described here is made of.
    int parts() const { return refinement * refinement * refinement; }
};

/// Brings the initial block to rest before time 0 (thesis 2.3): short updates, velocities zeroed after each.
struct Settling {
    int updates = 100;        ///< their number
    double time_step = 1e-4;  ///< s
    int substeps = 1;         ///< of each update
};

/// When an evaluation ends before its duration (thesis 2.6).
struct Stopping {
    bool plane_contact = true;       ///< a body particle comes within collision_distance of a plane
    double no_progress_after = 2.0;  ///< s without gain in mean x; 0 = never
};

/// A swimmer beside the one that is evaluated, with a gait of its own.
struct Companion {
    Creature creature;  ///< its body
    Gait gait;          ///< by which it swims
};

/// Something that water and bodies can't enter and that stays where it is: particles of infinite mass.
struct Obstacle {
    /// What it is made of: all of a sphere or box, or the places of `points`.
    enum class Shape { sphere, box, mesh };
    Shape shape = Shape::sphere;          ///< of this one
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

/// Everything that defines an experiment. What is made without an argument is water of one density, without friction
/// and drag; it needs some, in `fluid` and between `planes`. Scene JSON has thesis_tank() where it says nothing.
struct Scene {
    std::string name;                       ///< as messages give it
    std::string description;                ///< for people
    Scheme scheme = Scheme::conserving;     ///< by which it is computed
    double duration = 4.0;                  ///< s
    double time_step = 1.0 / 60;            ///< one frame, s
    SolverParameters solver;                ///< parameters of the scheme
    std::vector<Plane> planes;              ///< walls of the tank
    std::vector<PeriodicAxis> periodic;     ///< axes that have no ends; no planes stand across them
    std::optional<FluidBlock> fluid;        ///< the water; none: there is none
    std::optional<Creature> creature;       ///< the swimmer that is evaluated; none: there is none
    Settling settling;                      ///< before time 0
    Stopping stopping;                      ///< before the duration is over
    std::optional<MovingTank> moving_tank;  ///< none: the tank stays
    std::vector<Companion> companions;      ///< other swimmers
    std::vector<Obstacle> obstacles;        ///< what stands in the tank
    std::vector<Goal> goals;                ///< none: the distance along x

    /// Distance through the water along x, length, of a swimmer that got `distance` (length) along x over ground in
    /// `time` (s).
    double through_water(double distance, double time) const {
        const double current = (moving_tank ? moving_tank->current.x() : 0) + (fluid ? fluid->current.x() : 0);
        return distance - time * current;
    }
};

/// The tank of the thesis (2.3) with its water, whose mass falls from 2 at the bottom to 1/14 at the top, without a
/// swimmer: scheme `flex` with the parameters of Appendix A. The named scene thesis/tank is the same.
Scene thesis_tank();

}  // namespace natator
