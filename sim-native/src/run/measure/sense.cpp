#include "natator/measure.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <sstream>

#include "model/boundaries.h"
#include "model/check_model.h"
#include "natator/error.h"
#include "physics/constants.h"

namespace natator {
namespace {

constexpr std::size_t max_places = 1000;
constexpr double max_within = 1000;  // length
constexpr double outermost = 1e-6;   // of a body's length: lies as far out as another
constexpr double no_inertia = 1e-9;  // of the largest: a body that is a line does not resist turns about itself

/// The body's particles as the sums that motion is read off: place, velocity and mass of each. One that is held in
/// place counts as others do.
struct Cloud {
    Eigen::Matrix3Xd place, velocity;
    Eigen::VectorXd mass;
    Eigen::Vector3d mean{0, 0, 0}, centre_of_mass{0, 0, 0}, mean_velocity{0, 0, 0};

    template <class Real>
    Cloud(const Model& model, const Body& body, const State<Real>& state) {
        const auto count = static_cast<Eigen::Index>(body.particles.size());
        place.resize(3, count);
        velocity.resize(3, count);
        mass.resize(count);
        for (Eigen::Index i = 0; i < count; ++i) {
            const int particle = body.particles[static_cast<std::size_t>(i)];
            place.col(i) = state.position[particle].template cast<double>();
            velocity.col(i) = state.velocity[particle].template cast<double>();
            const double inverse = model.inverse_mass[particle];
            mass(i) = inverse > 0 ? 1 / inverse : 1;
            mean += place.col(i);
            centre_of_mass += mass(i) * place.col(i);
            mean_velocity += mass(i) * velocity.col(i);
        }
        mean /= static_cast<double>(count);
        centre_of_mass /= mass.sum();
        mean_velocity /= mass.sum();
    }
};

/// Angular velocity of a rigid body of the same angular momentum and inertia.
Eigen::Vector3d turn_of(const Cloud& cloud) {
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < cloud.place.cols(); ++i) {
        const Eigen::Vector3d arm = cloud.place.col(i) - cloud.centre_of_mass;
        const Eigen::Vector3d velocity = cloud.velocity.col(i) - cloud.mean_velocity;
        inertia += cloud.mass(i) * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
        momentum += cloud.mass(i) * arm.cross(velocity);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia);
    Eigen::Vector3d along = principal.eigenvectors().transpose() * momentum;
    const double least = no_inertia * principal.eigenvalues().maxCoeff();
    for (int k = 0; k < 3; ++k) {
        const double about = principal.eigenvalues()(k);
        along(k) = about > least ? along(k) / about : 0;
    }
    return principal.eigenvectors() * along;
}

/// Least squares over its muscles of drive = change of length / (strain times lateral place times rest length).
template <class Real>
std::vector<double> bend_of(const Model& model, const State<Real>& state, int swimmer) {
    const int actuators = model.actuators_of(swimmer), first = model.first_actuator_of(swimmer);
    std::vector<double> bend(static_cast<std::size_t>(actuators)), weight(bend.size());
    for (const Muscle& muscle : model.muscles) {
        const int actuator = muscle.actuator - first;
        if (actuator < 0 || actuator >= actuators) continue;  // another's
        const Spring& spring = model.springs[muscle.spring];
        const double length =
            (state.position[spring.a].template cast<double>() - state.position[spring.b].template cast<double>())
                .norm();
        const double reach = physics::muscle_strain * muscle.lateral;
        bend[actuator] += reach * (length / spring.rest_length - 1);
        weight[actuator] += reach * reach;
    }
    for (std::size_t i = 0; i < bend.size(); ++i) bend[i] = weight[i] > 0 ? bend[i] / weight[i] : 0;
    return bend;
}

/// How far out a particle lies on a side at rest.
double towards(SkinPlace::Side side, const Eigen::Vector3d& rest) {
    switch (side) {
        case SkinPlace::Side::left:
            return -rest.z();
        case SkinPlace::Side::right:
            return rest.z();
        case SkinPlace::Side::above:
            return rest.y();
        case SkinPlace::Side::below:
            return -rest.y();
    }
    return 0;
}

/// A place of the skin as it is now, and the water about it as far as it is summed up.
struct Probe {
    Eigen::Vector3d place{0, 0, 0}, velocity{0, 0, 0}, water{0, 0, 0};
    double weight = 0;
    int particles = 0;
};

template <class Real>
Probe probe_at(const Model& model, const Body& body, const State<Real>& state, const SkinPlace& at) {
    const std::vector<int>& slice = body.slices[static_cast<std::size_t>(at.slice)];
    double most = towards(at.side, model.position[slice.front()]);
    for (const int i : slice) most = std::max(most, towards(at.side, model.position[i]));
    const double least = most - outermost * std::max(body.length, 1e-3);
    Probe probe;
    double count = 0;
    for (const int i : slice) {
        if (towards(at.side, model.position[i]) < least) continue;
        probe.place += state.position[i].template cast<double>();
        probe.velocity += state.velocity[i].template cast<double>();
        ++count;
    }
    probe.place /= count;
    probe.velocity /= count;
    return probe;
}

/// Sums the water about all probes, in the order of the particles.
template <class Real>
void feel_water(const Model& model, const State<Real>& state, double within, std::vector<Probe>& probes) {
    if (probes.empty()) return;
    Eigen::AlignedBox3d reach;
    for (const Probe& probe : probes) reach.extend(probe.place);
    reach.min().array() -= within;
    reach.max().array() += within;
    for (const PeriodicAxis& periodic : model.periodic) {  // water comes from all around
        reach.min()[periodic.axis] = -std::numeric_limits<double>::infinity();
        reach.max()[periodic.axis] = std::numeric_limits<double>::infinity();
    }
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        const Eigen::Vector3d place = state.position[i].template cast<double>();
        if (!reach.contains(place)) continue;
        for (Probe& probe : probes) {
            const double part = minimum_image(model, place - probe.place).squaredNorm() / (within * within);
            if (part >= 1) continue;
            const double weight = (1 - part) * (1 - part) * (1 - part);
            probe.water += weight * state.velocity[i].template cast<double>();
            probe.weight += weight;
            ++probe.particles;
        }
    }
}

template <class Real>
std::vector<SkinFlow> flow_at(const Model& model, const Body& body, const State<Real>& state, const Sensing& sensing,
                              const Eigen::Matrix3d& axes) {
    std::vector<Probe> probes;
    for (const SkinPlace& place : sensing.flow) probes.push_back(probe_at(model, body, state, place));
    const SolverParameters& solver = model.parameters;
    const double within =
        sensing.within > 0 ? sensing.within : solver.solid_rest_distance + 2 * solver.fluid_rest_distance;
    feel_water(model, state, within, probes);
    std::vector<SkinFlow> flow;
    for (const Probe& probe : probes) {
        SkinFlow felt{.particles = probe.particles};
        if (probe.weight > 0) felt.velocity = axes.transpose() * (probe.water / probe.weight - probe.velocity);
        flow.push_back(felt);
    }
    return flow;
}

}  // namespace

void check_sensing(const Sensing& sensing, const Model& model, int swimmer) {
    const Body& body = model.body_of(swimmer);
    const auto refuse = [](const auto&... parts) {
        std::ostringstream text;
        (text << ... << parts);
        throw InputError(text.str());
    };
    if (body.particles.empty()) refuse("sense: the scene has no creature, whose senses they would be");
    if (sensing.flow.size() > max_places)
        refuse("flow has length ", sensing.flow.size(), ": must have length ", max_places, " at most");
    const auto slices = static_cast<int>(body.slices.size());
    for (std::size_t i = 0; i < sensing.flow.size(); ++i) {
        const int slice = sensing.flow[i].slice;
        if (slice < 0 || slice >= slices)
            refuse("flow[", i, "].slice = ", slice, ": must be a slice of the body, in [0, ", slices - 1, ']');
    }
    if (!(sensing.within >= 0 && sensing.within <= max_within))
        refuse("within = ", sensing.within, ": must be 0 or a length up to ", max_within);
    if (sensing.target && !sensing.target->allFinite()) refuse("target: must be three numbers");
}

template <class Real>
Senses sense(const Model& model, const State<Real>& state, const Sensing& sensing, int swimmer) {
    const Body& body = model.body_of(swimmer);
    Senses senses;
    if (body.particles.empty()) return senses;
    check_places_and_velocities(model, state);
    const Cloud cloud(model, body, state);
    senses.centre = cloud.mean + state.origin;
    senses.axes = body_rotation(model, body, body_places(body, state));
    senses.velocity = senses.axes.transpose() * cloud.mean_velocity;
    senses.turn_rate = senses.axes.transpose() * turn_of(cloud);
    senses.bend = bend_of(model, state, swimmer);
    senses.flow = flow_at(model, body, state, sensing, senses.axes);
    if (sensing.target) {
        const Eigen::Vector3d way = *sensing.target - senses.centre;
        senses.target_distance = way.norm();
        senses.target = senses.axes.transpose() * way;
        if (senses.target_distance > 0) *senses.target /= senses.target_distance;
    }
    return senses;
}

template Senses sense(const Model&, const State<float>&, const Sensing&, int);
template Senses sense(const Model&, const State<double>&, const Sensing&, int);

}  // namespace natator
