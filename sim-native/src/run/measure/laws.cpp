#include "run/laws.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <sstream>

#include "model/check_model.h"
#include "physics/dfsph.h"
#include "physics/laws.h"
#include "solver/law_name.h"

namespace natator {
namespace {

using physics::Law;
using physics::LawLimits;
using physics::LawMeasures;

// Spray can have a multiple of what falling gives: heavy water that meets light water, or a jet between two fronts.
constexpr double speed_margin = 3;  ///< of the speed of a fall
/// of masses: a light particle gets up to so many times the energy of a heavy one's fall, per mass
constexpr double max_unequal = 4;
constexpr double max_body_lengths = 90;  ///< a second, that anything goes unless it falls as fast
constexpr double energy_margin = 0.1;    ///< of the energy of a fall of all that moves
// What explicit forces set free, measured in a box of water: at most 14 cohesion at R = 1.5 s = 0.15, and without
// gravity, which gives no measure for it, 0.25 surface_tension at s = 0.1.
constexpr double cohesion_energy = 1.0 / 32, tension_energy = 5;
/// of the radius, by constraints in a substep: starts may be shifted by as much
constexpr double corrected_start = 0.01;
constexpr double disordered = 1.1;  ///< room in the box around water that is disordered, over what it needs
constexpr double depth_margin = 1;  ///< of the interaction radius
constexpr double reach_margin = 3;  ///< of a body's length

template <class Real>
physics::Vec3<Real> vec3(const Vector3<Real>& v) {
    return {v.x(), v.y(), v.z()};
}

/// Particles of the State that are behind a plane. A box around all mostly tells that there are none.
template <class Real>
void measure_depth(const Model& model, const State<Real>& state, const Vector3<Real>& low, const Vector3<Real>& high,
                   LawMeasures& measures) {
    const auto note = [&](double depth, int particle) {
        physics::add(measures, {.depth = depth, .deepest = particle});
    };
    for (const Plane& plane : model.planes) {
        const Eigen::Vector3d corner =
            (plane.normal.array() > 0).select(low.template cast<double>(), high.template cast<double>());
        if (plane.distance(corner) >= 0) continue;
        for (int i = 0; i < model.particles(); ++i)
            if (model.inverse_mass[i] > 0) note(-plane.distance(state.position[i].template cast<double>()), i);
    }
}

template <class Real>
void measure_reach(const Model& model, const State<Real>& state, LawMeasures& measures) {
    const std::vector<int>& body = model.body.particles;
    for (const int i : body) {
        const Vector3<Real> from = state.position[i] - state.position[body.front()];
        physics::add(measures, {.reach_square = static_cast<double>(from.squaredNorm()), .farthest = i});
    }
}

}  // namespace

Eigen::Vector3d bounded_gravity(const Model& model) {
    Eigen::Vector3d gravity = model.parameters.gravity;
    for (const PeriodicAxis& axis : model.periodic) gravity[axis.axis] = 0;
    if (model.water_box && !model.body.particles.empty())  // less what the water carries
        gravity *=
            1 - model.water_box->displaced_mass(model.body.spacing) * model.inverse_mass[model.body.particles.front()];
    return gravity;
}

template <class Real>
LawMeasures measure_laws(const Model& model, const State<Real>& state) {
    check_places_and_velocities(model, state);
    const Eigen::Vector3d gravity = bounded_gravity(model);
    const auto solid_gravity = vec3<Real>(gravity.cast<Real>());
    const auto fluid_gravity = vec3<Real>((model.parameters.buoyancy * gravity).cast<Real>());
    const bool sums = model.scheme != Scheme::flex;
    LawMeasures measures;
    Vector3<Real> low = Vector3<Real>::Constant(std::numeric_limits<Real>::max()), high = -low;
    Real most = -std::numeric_limits<Real>::max();
    for (int i = 0; i < model.particles(); ++i) {
        const double inverse_mass = model.inverse_mass[i];
        if (!(inverse_mass > 0)) continue;
        const Vector3<Real>&x = state.position[i], &v = state.velocity[i];
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
        const Real energy =
            physics::particle_energy(vec3<Real>(v), vec3<Real>(x), model.is_fluid(i) ? fluid_gravity : solid_gravity);
        if (sums) measures.energy += static_cast<double>(energy) / inverse_mass;
        if (!(energy > most)) continue;
        most = energy;
        measures.most_energetic = i;
    }
    measures.particle_energy = low.x() <= high.x() ? static_cast<double>(most) : 0;  // nothing moves, nothing has any
    measure_depth(model, state, low, high, measures);
    measure_reach(model, state, measures);
    return measures;
}

double LawMargins::largest() const {
    return std::max({particle_energy, energy, depth, reach, compression});
}

struct LawWatch::Parts {
    explicit Parts(const Model& model) : periodic_gravity((model.parameters.gravity - bounded_gravity(model)).norm()) {
        LawMeasures begin = measure_laws(model, initial_state<double>(model));
        length = longest = model.body.length;
        for (const CompanionBody& other : model.companions) {
            muscle_speed = std::max(muscle_speed, speed_of(other.gait, other.body.length));
            longest = std::max(longest, other.body.length);
        }
        time_step = model.time_step;
        bool soft = false;
        for (const Cluster& cluster : model.clusters) soft |= cluster.stiffness == 0;
        const Sources own = sources(model);
        for (const double inverse_mass : model.inverse_mass) mass += inverse_mass > 0 ? 1 / inverse_mass : 0;
        highest = begin.particle_energy;
        fallen = speed_margin * speed_margin *
                     (own.start + own.unequal * std::max(1.0, own.crowding) * own.fall + own.noise) +
                 own.forces;
        gain = mass * (energy_margin * (own.start + own.fall) + std::max(0.0, own.crowding - 1) * own.fall +
                       own.forces + own.noise);
        if (model.water_box) {
            const double carried = speed_margin * speed_margin * model.water_box->current.squaredNorm() / 2;
            fallen += carried;
            gain += mass * carried;
        }
        const double swum = square(max_body_lengths * length) / 2;
        if (length > 0) most = std::max(swum, 4 * std::max(1.0, own.crowding) * own.fall);
        // Flex' clamp of accelerations drives bodies without water to several times their muscles' speed; that is its
        // motion.
        if (model.scheme == Scheme::flex && own.crowding == 0) fallen += swum;
        body_alone = model.water_box && own.fall == 0;
        if (model.scheme == Scheme::flex) gain = std::numeric_limits<double>::infinity();
        first = begin.energy;
        limits.depth = depth_margin * model.parameters.radius;
        limits.reach = length > 0 && !soft ? reach_margin * length : std::numeric_limits<double>::infinity();
        set(0);
    }

    /// What the scene can bring forth without muscles, (length/s)^2, each as an energy over a mass.
    struct Sources {
        double start = 0;     ///< how fast something begins
        double fall = 0;      ///< over the height of the start, above which crowded water rises
        double crowding = 0;  ///< how many particles are where one would have room; 0 without fluid
        double unequal = 1;   ///< the heaviest mass over the lightest, which it can hit
        double forces = 0;    ///< of explicit forces of the water over their range
        double noise = 0;     ///< what corrections of a start leave in velocities, see physics::velocity_limit
    };
    static Sources sources(const Model& model) {
        const SolverParameters& p = model.parameters;
        const Eigen::Vector3d gravity = bounded_gravity(model);
        const double pull = gravity.norm() * std::max(1.0, std::abs(p.buoyancy)), spacing = p.fluid_rest_distance;
        Eigen::AlignedBox3d fluid;
        double low = std::numeric_limits<double>::max(), high = -low, lightest = low, heaviest = 0;
        int count = 0;
        Sources own;
        for (int i = 0; i < model.particles(); ++i) {
            if (model.is_fluid(i)) fluid.extend(model.position[i]), ++count;
            if (!(model.inverse_mass[i] > 0)) continue;
            lightest = std::min(lightest, 1 / model.inverse_mass[i]);
            heaviest = std::max(heaviest, 1 / model.inverse_mass[i]);
            low = std::min(low, gravity.dot(model.position[i]));
            high = std::max(high, gravity.dot(model.position[i]));
            own.start = std::max(own.start, model.velocity[i].squaredNorm() / 2);
        }
        if (!(heaviest > 0)) return own;
        own.noise = square(corrected_start * p.radius * p.substeps / model.time_step) / 2;
        own.unequal = std::min(heaviest / lightest, max_unequal);
        own.fall = std::max(1.0, std::abs(p.buoyancy)) * (high - low) + pull * p.radius;
        if (count == 0) return own;
        const double room = (fluid.sizes().array() + spacing).prod();
        own.crowding = std::max(
            1.0, disordered * model.particles() * spacing * spacing * spacing / room);  // solids take room, too
        own.forces = cohesion_energy * p.cohesion * square(p.radius / physics::thesis_substep);
        if (!(pull > 0)) own.forces += tension_energy * p.surface_tension * spacing;
        own.forces = std::min(own.forces,
                              square(p.radius * p.substeps / model.time_step) / 2);  // nobody sees what goes by faster
        const double expansion = physics::max_excess * p.substeps / model.time_step;
        const double slow = pull > 0 ? physics::expansion * std::sqrt(pull / spacing) : expansion;
        const double rate = std::min(expansion, slow);
        own.noise += square(spacing * rate) / 2;
        // What comes apart everywhere at this rate: r^2 / 6 is the mean square of the way from the middle, half of it
        // energy.
        if (own.crowding > 1.02 * disordered) own.noise += square(rate * fluid.diagonal().norm()) / 6;
        return own;
    }

    /// No part of a body of length L that beats f times a second goes faster than 2 pi f L, nor a slender one slower
    /// for a small amplitude: its curvature is that over its width.
    static double speed_of(const Gait& gait, double length) {
        double largest = 0;
        for (const double amplitude : gait.amplitude) largest = std::max(largest, std::abs(amplitude));
        if (largest > 0) largest = std::max(largest, 1.0);
        return 2 * std::numbers::pi * gait.frequency * std::max(1.0, gait.power) * largest * length;
    }

    void set(double time) {
        const double driven = square(muscle_speed) + square(periodic_gravity * time);
        limits.particle_energy = highest + std::min(fallen + driven / 2, most);
        limits.energy = first + gain + mass * square(periodic_gravity * time) / 2;
    }
    static double square(double v) { return v * v; }

    std::optional<Instability> look(const LawMeasures& m, double time, const char* stage) {
        set(time);
        const auto use = [](double& largest, double part, double of) {
            if (std::isfinite(of))
                largest = std::max(largest, of > 0     ? part / of
                                            : part > 0 ? std::numeric_limits<double>::infinity()
                                                       : 0);
        };
        use(margins.particle_energy, m.particle_energy - highest, limits.particle_energy - highest);
        use(margins.energy, m.energy - first, limits.energy - first);
        use(margins.depth, m.depth, limits.depth);
        use(margins.reach, std::sqrt(m.reach_square), limits.reach);
        const physics::Breach found = physics::breach(m, limits);
        if (found.law == Law::none) return std::nullopt;
        return Instability{std::max(found.particle, 0), stage, time, name(found.law)};
    }

    double periodic_gravity;
    double length = 0, longest = 0, time_step = 0, mass = 0, muscle_speed = 0;
    double highest = 0;                                     ///< energy of a particle at the start, (length/s)^2
    double fallen = 0;                                      ///< what falling may add to it
    double first = 0;                                       ///< energy that the run begins with, mass (length/s)^2
    double most = std::numeric_limits<double>::infinity();  ///< what all may add to it
    double gain = 0;                                        ///< what it may rise by
    double work = 0;                                        ///< of the muscles, by then
    bool begun = true;
    bool body_alone = false;  ///< and without weight: its energy is the same wherever the tank is
    LawLimits limits{};
    LawMargins margins;
};

LawWatch::LawWatch(const Model& model) : parts_(std::make_unique<Parts>(model)) {}
LawWatch::~LawWatch() = default;
LawWatch::LawWatch(const LawWatch& other) : parts_(std::make_unique<Parts>(*other.parts_)) {}
LawWatch::LawWatch(LawWatch&&) noexcept = default;
LawWatch& LawWatch::operator=(LawWatch&&) noexcept = default;

void LawWatch::drive_by(const Gait& gait) {
    parts_->muscle_speed = std::max(parts_->muscle_speed, Parts::speed_of(gait, parts_->length));
    parts_->set(0);
}

void LawWatch::drive_freely() {
    parts_->muscle_speed = std::max(parts_->muscle_speed, parts_->longest / parts_->time_step);
}

void LawWatch::go_on(const LawMeasures& measures) {
    parts_->highest = std::max(parts_->highest, measures.particle_energy);
    parts_->first = measures.energy;
    parts_->work = 0;
}

std::optional<Instability> LawWatch::start(const LawMeasures& measures) {
    auto found = parts_->look(measures, 0, "settling");
    parts_->first = measures.energy;
    parts_->work = 0;
    return found;
}

std::optional<Instability> LawWatch::look(const LawMeasures& measures, double work, double time) {
    LawMeasures own = measures;
    if (!parts_->begun) {
        parts_->first = measures.energy;
        parts_->work = work;
        parts_->begun = true;
    }
    const double by_muscles = work - parts_->work;
    own.energy -= by_muscles + energy_margin * std::abs(by_muscles);
    return parts_->look(own, time, "frame");
}

std::optional<Instability> LawWatch::look_at_compression(double mean_excess, double time) {
    parts_->margins.compression = std::max(parts_->margins.compression, mean_excess / physics::max_compression);
    return broken_by_compression(mean_excess, time);
}

std::optional<Instability> broken_by_compression(double mean_excess, double time) {
    if (mean_excess <= physics::max_compression) return std::nullopt;
    return Instability{0, "frame", time, name(Law::compression)};
}

template <class Real>
std::optional<Instability> broken_by_water(const Model& model, const Solver<Real>& solver, double time) {
    if (!model.water_box) return std::nullopt;
    const double sound = std::numbers::inv_sqrt3 * model.water_box->cell * model.parameters.substeps / model.time_step;
    Law broken = Law::none;
    solver.visit_lattice_cells([&](double density, const Eigen::Vector3d& velocity) {
        if (broken != Law::none) return;
        if (!std::isfinite(density) || !velocity.allFinite())
            broken = Law::finite;
        else if (velocity.norm() > sound)
            broken = Law::mach;
        else if (!(std::abs(density - 1) <= physics::max_compression))
            broken = Law::compression;
    });
    if (broken == Law::none) return std::nullopt;
    return Instability{0, "frame", time, name(broken)};
}

template std::optional<Instability> broken_by_water(const Model&, const Solver<float>&, double);
template std::optional<Instability> broken_by_water(const Model&, const Solver<double>&, double);

void LawWatch::restart() {
    if (!parts_->body_alone) parts_->begun = false;
}

void LawWatch::save(ByteWriter& to) const {
    const Parts& p = *parts_;
    for (const double value : {p.muscle_speed, p.highest, p.first, p.work}) to.add(value);
    to.add(p.begun);
    const auto& [particle_energy, energy, depth, reach, compression] = p.margins;
    for (const double value : {particle_energy, energy, depth, reach, compression}) to.add(value);
}

void LawWatch::restore(ByteReader& from) {
    Parts next = *parts_;
    for (double* value : {&next.muscle_speed, &next.highest, &next.first, &next.work}) from.read(*value);
    from.read(next.begun);
    auto& [particle_energy, energy, depth, reach, compression] = next.margins;
    for (double* value : {&particle_energy, &energy, &depth, &reach, &compression})
        std::memcpy(value, from.take(sizeof *value).data(), sizeof *value);  // may be infinite
    *parts_ = next;
}

const LawLimits& LawWatch::limits() const {
    return parts_->limits;
}
const LawMargins& LawWatch::margins() const {
    return parts_->margins;
}

template LawMeasures measure_laws(const Model&, const State<float>&);
template LawMeasures measure_laws(const Model&, const State<double>&);

}  // namespace natator
