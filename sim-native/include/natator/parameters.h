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

/// Solver parameters under the names of NVIDIA Flex. Those made without an argument are of water without friction and drag;
/// thesis_tank().solver has those of Appendix A of the thesis.
/// Units are those of the scene (length, second, mass); the ranges (sim-native/protocol/scenes.md) are checked when a scene is read and
/// in build_model, in a Model that a program makes those of `kernelSupport` and of radius / fluidRestDistance alone.
struct SolverParameters {
    int substeps = 4;       ///< substeps per frame, >= 1
    int numIterations = 4;  ///< constraint iterations per substep, >= 1
    /// In scheme `conserving` times that contacts, springs, clusters and planes are solved in each iteration, >= 1. A body's
    /// stiffness and the strength of its muscles need many more iterations than the pressure of the water, and cheaper ones.
    int solidIterations = 16;

    Eigen::Vector3d gravity{0, -10, 0};  ///< acceleration, length/s^2
    double radius = 0.15;                ///< interaction radius R of particles, length, > 0
    double solidRestDistance = 0.075;    ///< distance held between a solid and any other particle, 0 < d <= radius
    double fluidRestDistance = 0.10;     ///< spacing of the fluid at rest density, 0 < d < radius

    double dynamicFriction = 0.0;   ///< Coulomb coefficient against planes; > 0 also switches particle friction on
    double staticFriction = 0.0;    ///< static Coulomb coefficient, planes and particles
    double particleFriction = 0.0;  ///< dynamic Coulomb coefficient between particles
    double restitution = 0.0;       ///< rebound speed over impact speed at planes, [0, 1]
    double adhesion = 0.0;          ///< pull, length/s^2, that a particle touching a plane withstands, >= 0
    double sleepThreshold = 0.0;    ///< a particle slower than this, length/s, stays where it is, >= 0

    double maxSpeed = std::numeric_limits<float>::max();  ///< limit of |v|, length/s
    /// Limit of |dv|/h, length/s^2. Scheme `flex`: of every particle's change of velocity in a substep. Scheme
    /// `conserving`: of how fast particles are pushed apart that overlapped at the substep's start.
    double maxAcceleration = 100.0;
    /// Contacts take a particle's mass times exp(-k height), height against gravity, so that stacks settle faster;
    /// momentum is not kept then. k, 1/length, >= 0.
    double shockPropagation = 0.0;
    /// Damping per contact, 1/s, >= 0. Scheme `flex`: of the velocity, from the second contact on, as a single contact
    /// was measured not to damp. Scheme `conserving`: of the relative velocity in each contact, which keeps momentum.
    double dissipation = 0.0;
    double damping = 0.0;                                 ///< drag on the velocity, 1/s

    /// Pull between fluid particles beyond fluidRestDistance, push within it; dimensionless, >= 0. At contact the push
    /// moves a particle by cohesion * radius: in scheme `flex` per iteration before relaxation, as measured; in scheme
    /// `conserving` as a force, per (1/240 s)^2.
    double cohesion = 0.0;
    double surfaceTension = 0.0;        ///< pull that evens out the surface's curvature, length/s^2, >= 0
    double viscosity = 8.0;             ///< smoothing of the fluid's velocities, 1/s, in scheme `flex`
    double kernelSupport = 2.5;         ///< kernel radius in `conserving`, rest distances of the fluid, [2, 4]
    /// Scheme `conserving`: the weight of water that is deeper than the iterations hold up is carried by a hydrostatic pressure, so
    /// that it needs no more substeps. For a tank that stays full: its surface must stay above that level.
    bool modifiedPressure = false;
    double kinematicViscosity = 0.0;    ///< viscosity of the water in scheme `conserving`, length^2/s, >= 0
    double vorticityConfinement = 0.0;  ///< strengthens vortices: acceleration per vorticity, length/s, >= 0
    double solidPressure = 0.1;         ///< weight of solid particles in the fluid's density, in scheme `flex`
    double freeSurfaceDrag = 0.0;       ///< drag times the part of the rest density that a particle lacks, 1/s, >= 0
    double buoyancy = 1.0;              ///< factor on gravity for fluid particles

    double collisionDistance = 0.05;       ///< distance held from planes, length
    double particleCollisionMargin = 0.0;  ///< added to radius when pairs are found, length
    double shapeCollisionMargin = 0.0;     ///< added to collisionDistance when plane contacts are found, length

    RelaxationMode relaxationMode = RelaxationMode::local;
    /// omega, >= 0. Scheme `flex`: see RelaxationMode; 0 is the plain mean of a particle's corrections in local mode, and
    /// none of them in global mode. Scheme `conserving`: a factor on every correction, 0 switches the constraints off.
    double relaxationFactor = 1.0;

    /// Fluid neighbours kept per particle, the first found in cell order, in scheme `flex`; `conserving` keeps all.
    int maxNeighborsPerParticle = 96;
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
