#pragma once

#include <Eigen/Core>
#include <limits>

namespace natator {

/// Which update rule advances the particles.
enum class Scheme {
    flex,        ///< behaves as NVIDIA Flex 1.2.0 was measured to behave
    conserving,  ///< incompressible water (divergence-free SPH) and solids by mass splitting; pair forces equal and opposite
    lattice,     ///< submerged: water on a lattice (cumulant lattice Boltzmann), solids as in conserving
};

/// How the summed corrections of one iteration are scaled before they are applied.
enum class RelaxationMode {
    global = 0,  ///< x += omega * sum
    local = 1,   ///< x += min(1, (1 + omega) / n) * sum, n = number of constraints on the particle
};

/// What scheme `flex` alone has, under the names of NVIDIA Flex; from Appendix A of the thesis.
struct FlexParameters {
    double viscosity = 8.0;      ///< smoothing of the fluid's velocities, 1/s, >= 0
    double solidPressure = 0.1;  ///< weight of solid particles in the fluid's density, >= 0
    RelaxationMode relaxationMode = RelaxationMode::local;
    int maxNeighborsPerParticle = 96;  ///< fluid neighbours kept per particle, the first found in cell order
};

/// What scheme `conserving` alone has, and `lattice` of it but for the kernel and the pressure.
struct ConservingParameters {
    /// Times that contacts, springs, clusters and planes are solved in each iteration, >= 1. A body's stiffness and the strength of
    /// its muscles need many more iterations than the pressure of the water, and cheaper ones.
    int solid_iterations = 16;
    double kinematic_viscosity = 0.0;  ///< of the water, length^2/s, >= 0
    double kernel_support = 2.5;       ///< kernel radius, rest distances of the fluid, [2, 4]
    /// The weight of water that is deeper than the iterations hold up is carried by a hydrostatic pressure, so that it needs no more
    /// substeps. For a tank that stays full: its surface must stay above that level.
    bool modified_pressure = false;
};

/// Parameters of the solver: those that the schemes share, and those of one. What is made without an argument is water without friction
/// and drag; thesis_tank().solver has the values of Appendix A of the thesis. Scene JSON has them all in one object, under the names of
/// NVIDIA Flex: `max_speed` is `maxSpeed` there, `iterations` `numIterations`.
/// Units are those of the scene (length, second, mass); the ranges (sim-native/protocol/scenes.md) are checked when a scene is read and
/// in build_model, in a Model that a program makes those of `kernel_support` and of radius / fluid_rest_distance alone.
struct SolverParameters {
    int substeps = 4;    ///< substeps per frame, >= 1
    int iterations = 4;  ///< constraint iterations per substep, >= 1
    FlexParameters flex;
    ConservingParameters conserving;

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

    /// Pull between fluid particles beyond fluid_rest_distance, push within it; dimensionless, >= 0. At contact the push
    /// moves a particle by cohesion * radius: in scheme `flex` per iteration before relaxation, as measured; in scheme
    /// `conserving` as a force, per (1/240 s)^2.
    double cohesion = 0.0;
    double surface_tension = 0.0;        ///< pull that evens out the surface's curvature, length/s^2, >= 0
    double vorticity_confinement = 0.0;  ///< strengthens vortices: acceleration per vorticity, length/s, >= 0
    double free_surface_drag = 0.0;      ///< drag times the part of the rest density that a particle lacks, 1/s, >= 0
    double buoyancy = 1.0;               ///< factor on gravity for fluid particles

    double collision_distance = 0.05;        ///< distance held from planes, length
    double particle_collision_margin = 0.0;  ///< added to radius when pairs are found, length
    double shape_collision_margin = 0.0;     ///< added to collision_distance when plane contacts are found, length

    /// omega, >= 0. Scheme `flex`: see RelaxationMode; 0 is the plain mean of a particle's corrections in local mode, and
    /// none of them in global mode. Scheme `conserving`: a factor on every correction, 0 switches the constraints off.
    double relaxation_factor = 1.0;
};

/// Half space a*x + b*y + c*z + d >= 0 that particles are kept in; (a, b, c) has length 1.
struct Plane {
    Eigen::Vector3d normal{0, 1, 0};
    double offset = 0;  ///< d

    /// Signed distance of a point, positive inside.
    double distance(const Eigen::Vector3d& point) const { return normal.dot(point) + offset; }
};

/// An axis along which the tank closes up with itself: water that leaves at one end comes in at the other, and what is near
/// one end is next to what is near the other. Water is wrapped; bodies are where they have come to, beyond the ends too, and
/// the water meets them as many lengths of the tank back. Scheme `conserving` only.
struct PeriodicAxis {
    int axis = 0;  ///< 0 = x, 2 = z
    double low = 0, high = 0;  ///< where the ends are, length

    double length() const { return high - low; }
};

}  // namespace natator
