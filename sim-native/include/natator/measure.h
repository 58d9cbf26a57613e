#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"

/// @file
/// What is read off a State. Nothing here writes to it. What takes a Model throws InputError if the State has not as
/// many particles. Real is float or double.
namespace natator {

/// Mean x over the body's particles, length (thesis 2.6); 0 without a body.
template <class Real>
double mean_x(const Body& body, const State<Real>& state);

/// Whether any particle of a swimmer's body (0: Model::body; then the companions') is within collision_distance of any
/// plane. The solver leaves a particle that it pushes out of a plane at that distance to within rounding, so rounding
/// (1e-6 of the plane's offset + 1) counts as touching.
template <class Real>
bool touches_plane(const Model& model, const State<Real>& state, int swimmer = 0);

/// FNV-1a (64 bits) over the bytes of all positions, then all velocities, each as x, y, z, lowest
/// byte of each number first.
template <class Real>
std::uint64_t state_hash(const State<Real>& state);

/// Where a body is and how it lies, against the model at rest. Its rotation is that of all its particles that fits best
/// (Umeyama 1991), so that bends to both sides do not count.
struct Pose {
    Eigen::Vector3d centre{0, 0, 0};   ///< mean of its particles, length
    Eigen::Vector3d heading{1, 0, 0};  ///< where its head points; length 1
    double yaw = 0;                    ///< angle of the heading in the horizontal plane, from +x towards +z, rad
    double pitch = 0;                  ///< angle of the heading above the horizontal plane, rad
    double roll = 0;                   ///< angle of its back about its heading, from vertical to its right, rad
};

/// Mean of some places; 0 of none.
Eigen::Vector3d mean_place(const std::vector<Eigen::Vector3d>& places);

/// Mean of the body's particles in the model at rest, length.
Eigen::Vector3d rest_centre(const Model& model);

/// The rotation of a body from its rest shape that fits best: its columns are where its forward, up and right point.
/// `places` as in pose_of, and refused as there; the identity for fewer than three.
Eigen::Matrix3d body_rotation(const Model& model, const Body& body, const std::vector<Eigen::Vector3d>& places);

/// `places`: of a body's particles, in the order of Body::particles; of more or fewer InputError is thrown. A body of
/// fewer than three has no rotation.
Pose pose_of(const Model& model, const Body& body, const std::vector<Eigen::Vector3d>& places);

/// Places of the body's particles in the coordinates of its tank, in the order of Body::particles.
template <class Real>
std::vector<Eigen::Vector3d> body_places_in_tank(const Body& body, const State<Real>& state);

/// Places over ground of the body's particles, in the order of Body::particles.
template <class Real>
std::vector<Eigen::Vector3d> body_places(const Body& body, const State<Real>& state);

/// Where a body has gone and how it lies, against the model at rest. Its rotation is that of all its particles that
/// fits best (Umeyama 1991), so that bends to both sides do not count.
struct Course {
    double forward = 0;  ///< way along its own heading, length: along the bisector of headings at start and end, which
                         ///< is the chord of an arc
    double yaw = 0;      ///< angle of the heading in the horizontal plane, from +x towards +z, rad
    double roll = 0;     ///< angle of its back about its heading, from the vertical towards its right, rad
};

/// The course of one of the model's bodies that has come to `end`, `distance` along x.
template <class Real>
Course course_of(const Model& model, const Body& body, const State<Real>& end, double distance);

/// Momentum of movable particles, beside the sizes that it is a sum of.
struct Momentum {
    double linear = 0;        ///< |sum of m v|, mass length/s
    double angular = 0;       ///< |sum of m (x - c) x v| about the centre of mass c, mass length^2/s
    double linear_size = 0;   ///< sum of |m v|
    double angular_size = 0;  ///< sum of |m (x - c) x v|
};

/// Momentum of the movable ones of the given particles.
template <class Real>
Momentum measure_momentum(const Model& model, const State<Real>& state, const std::vector<int>& particles);

/// Velocity of the centre of mass of the movable ones of the given particles, length/s; 0 without any.
template <class Real>
Eigen::Vector3d centre_velocity(const Model& model, const State<Real>& state, const std::vector<int>& particles);

/// Momentum of all movable particles.
template <class Real>
Momentum measure_momentum(const Model& model, const State<Real>& state);

/// How a swimmer moves, in the numbers of fluid mechanics. U = |change of mean x| / simulated time, L = the body's
/// length, f = the gait's frequency, A = peak-to-peak amplitude of the tail, nu = kinematic_viscosity.
struct SwimmingNumbers {
    double tail_amplitude = 0;              ///< A, length: mean over the last beats, three at most
    std::optional<double> strouhal;         ///< f A / U, with the U of the same beats; none at rest
    std::optional<double> reynolds;         ///< U L / nu; none where nu is 0
    std::optional<double> swimming_number;  ///< 2 pi f A L / nu (Gazzola and others 2014); none where nu is 0
    double across = 0;                      ///< water_across of the body
    /// at the end, in volumes of the body, see cavities(); none without gravity
    std::optional<double> cavities;
};

/// How many spacings of the water, or cells, the body is across: the lesser of width and height of its thickest slice
/// at rest. Below `min_spacings_across` its speed may change by half and more with a finer water. 0 without a body or
/// water.
double water_across(const Model& model);
inline constexpr double min_spacings_across = 4;  ///< spacings of the water
/// "the body is 1.5 spacings of the water across, of which it needs 4: ..." where it is below `min_spacings_across`;
/// else empty.
std::string warning_of_across(double across);

/// Mean z of the body's last slice, length: across the swimmer's heading at the start. 0 without a body.
template <class Real>
double tail_z(const Body& body, const State<Real>& state);

/// Peak-to-peak amplitude of a periodic motion that may drift: in each of the last three periods, as far as there are
/// so many, the range of what is left once the line from its first to its last value is taken off; their mean. `path`
/// has a value every `time_step` (s). None if it is shorter than a period, or a period than eight steps.
std::optional<double> peak_to_peak(const std::vector<double>& path, double time_step, double period);

/// Volume of the water, in volumes of the body, that is held together no longer although it lies deep: with less than
/// 0.9 of rest density, below which the scheme gives water no pressure, and deeper below the surface than the kernel's
/// support. Water follows a body that moves at u only where its pressure exceeds some rho u^2 / 2; elsewhere it tears
/// off, as there are no negative pressures, and the swim is one for this depth and gravity alone. The surface is where
/// 95 % of the water lie below, as in a tank. `densities`: by particle, in units of rest density. None without a body
/// or gravity.
template <class Real>
std::optional<double> cavities(const Model& model, const State<Real>& state, const std::vector<Real>& densities);

/// Dimensionless numbers of a run that got `distance` (length) in `simulated` (s), with its tail at `tail` (tail_z for
/// each frame, length, the start first) and its body at `path` (mean_x through the water, likewise). None unless a body
/// with muscles swims in water of scheme `conserving` or `lattice`, or if the tail did not beat once; see peak_to_peak.
std::optional<SwimmingNumbers> swimming_numbers(const Model& model, const Gait& gait, double distance, double simulated,
                                                const std::vector<double>& tail, const std::vector<double>& path);

/// The water's particles on a grid with cells as wide as they are apart at rest, over the box that holds them. The
/// velocity is Shepard's mean of those within two cells (Shepard 1968), weighted by Wendland's kernel C2; the density
/// the sum of their volumes times that kernel. Throws InputError for particles so far apart that there would be more
/// than 100 million cells. Without particles of water, as in scheme `lattice`, it has no cells: Simulation::water has
/// those of the lattice. `pressures`: of each particle (Solver::pressures), whose mean by the same weights it has then;
/// empty: it has none.
template <class Real>
WaterField water_field(const Model& model, const State<Real>& state, const std::vector<Real>& pressures = {});

/// Where a body feels the water: the particles of a slice that lie outermost on one of its sides at rest.
struct SkinPlace {
    /// As the body lies at rest.
    enum class Side { left, right, above, below };

    int slice = 0;           ///< 0 = head
    Side side = Side::left;  ///< of the slice
};

/// What a swimmer is asked for beside its own pose.
struct Sensing {
    std::vector<SkinPlace> flow{};  ///< 1000 at most
    /// Distance from a place up to which water counts, length; 0: solid_rest_distance + 2 fluid_rest_distance.
    double within = 0;
    std::optional<Eigen::Vector3d> target{};  ///< where it shall go, length over ground
};

/// Throws InputError unless the swimmer (0: the body; then the companions) has one, each place is on it, and `within`
/// is 0 or a length up to 1000.
void check_sensing(const Sensing& sensing, const Model& model, int swimmer = 0);

/// The water about a place of the skin.
struct SkinFlow {
    /// Velocity of the water less that of the place, along the body's own axes, length/s: mean over the fluid particles
    /// within the distance s that is asked for, weighted by (1 - (r/s)^2)^3. 0 without any.
    Eigen::Vector3d velocity{0, 0, 0};
    int particles = 0;  ///< number of fluid particles that it is a mean over
};

/// What a swimmer knows of itself and of the water. "Own axes" are forward, up and right of its body.
struct Senses {
    Eigen::Vector3d centre{0, 0, 0};  ///< mean of the body's particles, length over ground
    /// Own axes as columns: forward, up, right, each of length 1. Those of the rotation of all particles that fits best
    /// (Umeyama 1991), so that bends to both sides do not count.
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    /// Velocity of the centre of mass, along own axes, length/s; in a moving tank less its current.
    Eigen::Vector3d velocity{0, 0, 0};
    Eigen::Vector3d turn_rate{0, 0, 0};  ///< angular velocity about own axes, rad/s: angular momentum over inertia
    /// How each actuator's muscles are contracted, in units of its drive: what drive would ask for the lengths that
    /// they have, in the mean over them.
    std::vector<double> bend;
    std::vector<SkinFlow> flow;  ///< one for each place of Sensing::flow
    /// direction from the centre, along own axes, of length 1; 0 where it is there
    std::optional<Eigen::Vector3d> target;
    double target_distance = 0;  ///< from the centre, length
};

/// Reads those of a swimmer off a state. `sensing` must fit it (check_sensing). Throws InputError if the state has not
/// as many particles as the model. Real is float or double.
template <class Real>
Senses sense(const Model& model, const State<Real>& state, const Sensing& sensing, int swimmer = 0);

extern template Senses sense(const Model&, const State<float>&, const Sensing&, int);
extern template Senses sense(const Model&, const State<double>&, const Sensing&, int);

}  // namespace natator
