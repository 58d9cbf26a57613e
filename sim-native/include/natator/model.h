#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "natator/gait.h"
#include "natator/scene.h"

namespace natator {

/// What water meets at an end of its box.
enum class WaterFace {
    periodic,
    free_slip,
    no_slip,
    open,  ///< more water, that goes with the current
};

/// What stands in water on a lattice.
struct WaterObstacle {
    Obstacle obstacle;  ///< as the Scene has it
    int particles = 0;  ///< number of the Model's particles that make it up
};

/// Water on a lattice of cubic cells, as scheme `lattice` has it.
struct WaterBox {
    Eigen::Vector3i cells{1, 1, 1};   ///< along x, y, z
    double cell = 1;                  ///< edge of a cell, length
    Eigen::Vector3d corner{0, 0, 0};  ///< the lowest, length
    WaterFace faces[3][2] = {};       ///< along x, y, z: below, above; both periodic or none
    double viscosity = 0.001;         ///< kinematic, length^2/s, above 0
    double density = 1;               ///< mass/length^3
    /// Velocity with which all water begins, and comes in at open ends, length/s
    Eigen::Vector3d current{0, 0, 0};
    double smagorinsky = 0;                     ///< constant of the eddies' viscosity; 0: no eddies are added
    std::vector<WaterObstacle> obstacles = {};  ///< in the order of their particles, which are behind all bodies'

    double cell_mass() const { return density * cell * cell * cell; }  ///< of water in a cell, mass
    /// Whether the flow is plane: one cell deep along y, all along which it is the same.
    bool is_plane() const { return cells.y() == 1 && faces[1][0] == WaterFace::periodic; }
    /// Of water in the place of a particle, whose cube, or in plane flow square, has so long an edge; mass.
    double displaced_mass(double edge) const {
        return is_plane() ? density * cell * edge * edge : density * edge * edge * edge;
    }
};

/// The water on a grid of cubic cells, in the coordinates of its tank; values are by cell, x first, then y, then z.
struct WaterField {
    Eigen::Vector3i cells{0, 0, 0};   ///< along x, y, z
    double cell = 0;                  ///< edge of a cell, length
    Eigen::Vector3d corner{0, 0, 0};  ///< the grid's lowest, length
    /// length/s; 0 where there is no water, about the body's where that is, in scheme `lattice`
    std::vector<Eigen::Vector3f> velocity;
    /// in rest densities: about 1 in water, less at a surface or a body, 0 without
    std::vector<float> density;
    /// mass/(length s^2): in scheme `lattice` c_s^2 (rho - rho_0), 0 at rest; in `conserving` the mean of
    /// Solver::pressures, NaN without water and before the first update; empty in `flex`
    std::vector<float> pressure;
};

/// Bits of a particle's phase: a group number and flags, as NVIDIA Flex packs them.
namespace phase {
inline constexpr std::uint32_t group_mask = 0x000fffff;         ///< the group number
inline constexpr std::uint32_t self_collide = 1u << 20;         ///< collides with particles of its own group
inline constexpr std::uint32_t self_collide_filter = 1u << 21;  ///< but not with those near it at rest
inline constexpr std::uint32_t fluid = 1u << 22;                ///< takes part in the density constraint
}  // namespace phase

/// Distance constraint between two particles.
struct Spring {
    int a = 0;               ///< one particle
    int b = 0;               ///< the other one
    double rest_length = 0;  ///< length
    double stiffness = 1;    ///< [0, 1]
};

/// Shape-matching constraint: particles that keep the shape they have at rest.
struct Cluster {
    std::vector<int> particles;                ///< its members
    std::vector<Eigen::Vector3d> rest_offset;  ///< rest position minus plain mean of the rest positions, per particle
    double stiffness = 0.2;                    ///< [0, 1]
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< first guess of the rotation fit
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();              ///< first value of the stored centre
};

/// A spring that an actuator drives: rest length l = l_rest (1 + 1/2 z_m a u), thesis (2.7) and (2.8).
struct Muscle {
    int spring = 0;    ///< which of Model::springs
    int actuator = 0;  ///< in the order of Creature::actuator_list; those of companions follow
    /// z_m in [-1, 1], -1 = left edge, +1 = right edge; of one that bends up and down, lower and upper
    double lateral = 0;
};

/// Which particles make up the swimmer. Slice 0 is the head.
struct Body {
    std::vector<int> particles;            ///< by slice from the head, then y, then z
    std::vector<std::vector<int>> slices;  ///< the particles of each slice
    double length = 0;                     ///< head to tail at rest, length
    double spacing = 0;                    ///< of its particles at rest, length
};

/// A swimmer beside the one that is evaluated.
struct CompanionBody {
    Body body;               ///< its particles
    Gait gait;               ///< by which it swims
    int first_actuator = 0;  ///< first actuator of its muscles, after the body's and earlier companions'
    int first_spring = 0;    ///< first of its springs, likewise
};

/// All that stays constant while a scene runs. One Model serves any number of States, and of threads as long as none
/// changes it. Per-particle vectors have the length of `position`.
struct Model {
    Scheme scheme = Scheme::conserving;  ///< by which it is computed
    SolverParameters parameters;         ///< of the solver
    double time_step = 1.0 / 60;         ///< one frame, s

    std::vector<Eigen::Vector3d> position;       ///< at the start
    std::vector<Eigen::Vector3d> velocity;       ///< at the start
    std::vector<double> inverse_mass;            ///< 0 = held in place
    std::vector<std::uint32_t> phase;            ///< group and flags, see natator::phase
    std::vector<Eigen::Vector3d> rest_position;  ///< for self_collide_filter; empty if no particle has it

    std::vector<Plane> planes;              ///< walls of the tank
    std::optional<WaterBox> water_box;      ///< the water of scheme `lattice`, if any; in the others it is particles
    std::vector<PeriodicAxis> periodic;     ///< at most one an axis; all planes are along them
    std::vector<Spring> springs;            ///< those of muscles among them
    std::vector<Cluster> clusters;          ///< from the head on
    std::vector<Muscle> muscles;            ///< the springs that actuators drive
    int actuators = 0;                      ///< number of the body's actuators; a gait has as many
    Body body;                              ///< the swimmer that is evaluated; without particles if there is none
    std::vector<CompanionBody> companions;  ///< the others

    int swimmers() const { return 1 + static_cast<int>(companions.size()); }  ///< 0: the body; then the companions
    const Body& body_of(int swimmer) const { return swimmer == 0 ? body : companions[swimmer - 1].body; }  ///< its body
    int first_actuator_of(int swimmer) const {  ///< of all actuators; of one more than there are: their number
        if (swimmer == 0) return 0;
        if (swimmer < swimmers()) return companions[swimmer - 1].first_actuator;
        return companions.empty()
                   ? actuators
                   : companions.back().first_actuator + static_cast<int>(companions.back().gait.amplitude.size());
    }
    int actuators_of(int swimmer) const {  ///< their number
        return first_actuator_of(swimmer + 1) - first_actuator_of(swimmer);
    }
    int first_spring_of(int swimmer) const {  ///< of all springs; of one more than there are: their number
        if (swimmer == 0) return 0;
        return swimmer < swimmers() ? companions[swimmer - 1].first_spring : static_cast<int>(springs.size());
    }

    int particles() const { return static_cast<int>(position.size()); }             ///< their number
    bool is_fluid(int i) const { return (phase[i] & natator::phase::fluid) != 0; }  ///< whether particle i is of water
};

/// Lays out the particles, clusters and muscles of a scene: first the body (by slice from the head, then y, then z),
/// then the fluid (by x, then y, then z). Springs are sorted by actuator, front particle, rear particle; springs that
/// join the same two particles are separate, neighbouring entries. A creature's `refinement` n makes each particle of
/// its body n x n x n of them, one after the other by x, then y, then z, as model/refine_body.h says. Throws InputError
/// when the scene has no particles, or more particles or springs than limits.h allows, when a particle starts beyond a
/// plane, and when an actuator has no muscle. Of a Scene that a program made it is checked, too, that lists have sizes
/// that belong together, that slices which are named are there, that counts, lengths and masses are above 0, the
/// duration is a number and normals of planes have length 1; that the solver's parameters have the ranges of
/// sim-native/protocol/scenes.md, and that scheme `conserving` can compute the water by them and beside these planes.
/// All else has the ranges of that page, which load_scene and parse_scene have checked.
Model build_model(const Scene& scene);

/// A place, velocity or force along x, y, z.
template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;

/// All that changes while a scene runs, in the order of the Model's particles.
/// Real is float (default) or double (reference runs).
template <class Real>
struct State {
    std::vector<Vector3<Real>> position;                    ///< length
    std::vector<Vector3<Real>> velocity;                    ///< length/s
    std::vector<Eigen::Quaternion<Real>> cluster_rotation;  ///< kept between iterations, substeps and frames
    std::vector<Vector3<Real>> cluster_centre;              ///< stored centre with its dead band
    std::vector<Real> spring_rest_length;                   ///< length, as the muscles are driven
    /// Where the coordinates of a moving tank begin over ground, length: what is at x is at x + origin there.
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    double time = 0;  ///< s since the end of settling
};

/// The State that a Model starts from. Throws InputError as a Solver of the Model does.
template <class Real>
State<Real> initial_state(const Model& model);

/// Throws InputError unless the gait has one amplitude and one phase per actuator and its values are within
/// frequency (0, 60] 1/s, amplitude [0, 2], phase [0, 1] turns, power [0.5, 4], and if there are offsets, one per
/// actuator with |offset| + amplitude at most 2.
void check_gait(const Gait& gait, int actuators);

/// What drives each actuator's muscles at `time` (s): o + a u, offset plus amplitude times activation, times the start
/// ramp, except in scheme `flex`. The gait must fit the swimmer (check_gait), 0 being the body. Throws InputError if it
/// has not one value for each of its actuators.
std::vector<double> drive(const Model& model, const Gait& gait, double time, int swimmer = 0);

/// Sets the rest length of every muscle for `time` (s): l = l_rest (1 + 1/2 z_m (o + a u)), thesis (2.7) and (2.8).
/// The gait must fit the model (check_gait). The muscles of companions follow their own gaits. Throws InputError if
/// there is not one value for each actuator, or the state has not the model's number of springs.
template <class Real>
void actuate(const Model& model, const Gait& gait, double time, State<Real>& state);

/// Sets the rest length of every muscle for `time` (s) from `driven`, one value o + a u in [-2, 2] for each actuator of
/// the body, wherever it comes from, or for each of all swimmers; without theirs companions follow their own gaits.
/// Throws InputError if there are neither so many, or the state has not the model's number of springs.
template <class Real>
void actuate(const Model& model, std::vector<double> driven, double time, State<Real>& state);

/// What drives each actuator's muscles at a time (s), as `drive` gives it for a gait: those of the body, or of all
/// swimmers.
using Drive = std::function<std::vector<double>(double time)>;

extern template void actuate(const Model&, const Gait&, double, State<float>&);
extern template void actuate(const Model&, const Gait&, double, State<double>&);
extern template void actuate(const Model&, std::vector<double>, double, State<float>&);
extern template void actuate(const Model&, std::vector<double>, double, State<double>&);

}  // namespace natator
