#include "device_model.h"

#include <algorithm>
#include <limits>

#include "ghost_transforms.h"
#include "kernel_choice.h"
#include "model/background_pressure.h"
#include "model/boundaries.h"
#include "model/water_volumes.h"
#include "natator/error.h"
#include "physics/effects.h"
#include "solver/cpu/cell_grid.h"
#include "solver/cpu/substep.h"
#include "solver/solids/cpu/solids.h"

namespace natator::cuda {
namespace {

template <class Real>
Vec3<Real> vec3(const Eigen::Vector3d& v) {
    return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}

/// Cells of about the search distance / 4, as on the CPU: memory is not short there.
int cells_off_chip(const Model& model) {
    return 4096 + 16 * model.particles();
}

/// Particles listed by kind: position k of the result is what stands at `begin[k]` to `begin[k + 1]` of `incidences`.
struct Lists {
    std::vector<int> begin;
    std::vector<Incidence> incidences;
    explicit Lists(const std::vector<std::vector<Incidence>>& by_particle) {
        for (const auto& list : by_particle) {
            begin.push_back(static_cast<int>(incidences.size()));
            incidences.insert(incidences.end(), list.begin(), list.end());
        }
        begin.push_back(static_cast<int>(incidences.size()));
    }
};

}  // namespace

template <class Real>
DeviceModel<Real>::DeviceModel(const Model& model, bool whole_gpu) {
    view_.plan = make_plan(model);
    view_.scheme = model.scheme;
    set_constants(model);
    number_particles(model);
    upload_particles(model);
    if (model.scheme != Scheme::flex) set_conserving(model);
    upload_solids(model);
    const bool many = whole_gpu || supports_both(model);
    view_.grid = grid_over(model, view_.search_distance, 0, many ? cells_off_chip(model) : cells_on_chip(model));
    if (view_.plan.water) set_water(model);
}

template <class Real>
void DeviceModel<Real>::set_constants(const Model& model) {
    const cpu::Constants<Real> constants(model.parameters);
    const SolverParameters& p = model.parameters;
    view_.radius = constants.radius;
    view_.inverse_radius = constants.inverse_radius;
    view_.search_distance = constants.search_distance;
    view_.solid_rest_distance = constants.solid_rest_distance;
    view_.density_scale = constants.density_scale;
    view_.dynamic_friction = constants.dynamic_friction;
    view_.static_friction = constants.static_friction;
    view_.particle_friction = constants.particle_friction;
    view_.collision_distance = constants.collision_distance;
    view_.plane_search_distance = constants.plane_search_distance;
    view_.relaxation_factor = constants.relaxation_factor;
    view_.max_speed = constants.max_speed;
    view_.viscosity = static_cast<Real>(p.flex.viscosity);
    view_.damping = static_cast<Real>(p.damping);
    view_.max_acceleration = static_cast<Real>(p.max_acceleration);
    view_.solid_pressure = static_cast<Real>(p.flex.solidPressure);
    view_.restitution = static_cast<Real>(p.restitution);
    view_.touching_distance = constants.collision_distance + Real(physics::touching_tolerance) * constants.radius;
    view_.min_impact_speed = 2 * static_cast<Real>(p.gravity.norm());
    view_.dissipation = static_cast<Real>(p.dissipation);
    view_.cohesion_strength = static_cast<Real>(p.cohesion) * constants.radius;
    view_.cohesion_slope = constants.cohesion_slope;
    view_.gradient_estimate = constants.gradient_estimate;
    view_.adhesion = static_cast<Real>(p.adhesion);
    view_.sleep_threshold = static_cast<Real>(p.sleep_threshold);
    view_.surface_tension = static_cast<Real>(p.surface_tension);
    view_.vorticity = static_cast<Real>(p.vorticity_confinement);
    view_.free_surface_drag = static_cast<Real>(p.free_surface_drag);
    view_.shock_propagation = static_cast<Real>(p.shock_propagation);
    view_.up = vec3<Real>(-p.gravity.normalized());
    view_.local_relaxation = p.flex.relaxationMode == RelaxationMode::local;
    view_.gravity = vec3<Real>(p.gravity);
    view_.fluid_gravity = vec3<Real>(p.gravity * p.buoyancy);
    view_.bounded_gravity = vec3<Real>(gravity_on_walls(model));
    view_.bounded_fluid_gravity = vec3<Real>(gravity_on_walls(model) * p.buoyancy);
    view_.iterations = p.iterations;
    view_.solid_iterations = p.conserving.solid_iterations;
    view_.max_neighbours = p.flex.maxNeighborsPerParticle;
    view_.planes = static_cast<int>(model.planes.size());
    for (int k = 0; k < view_.planes; ++k) {
        const Plane& plane = model.planes[k];
        view_.plane[k] = {{vec3<Real>(plane.normal), static_cast<Real>(plane.offset)},
                          {vec3<double>(plane.normal), plane.offset}};
    }
}

/// The fluid first, then the solids, each in the Model's order.
template <class Real>
void DeviceModel<Real>::number_particles(const Model& model) {
    view_.particles = model.particles();
    number_of_.resize(model.particles());
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) number_of_[i] = view_.fluid++;
    for (int i = 0; i < model.particles(); ++i)
        if (!model.is_fluid(i)) number_of_[i] = view_.fluid + view_.solids++;

    particle_of_.resize(model.particles());
    for (int i = 0; i < model.particles(); ++i) particle_of_[number_of_[i]] = i;
}

template <class Real>
void DeviceModel<Real>::upload_particles(const Model& model) {
    std::vector<Real> inverse_mass(model.particles());
    std::vector<std::uint32_t> phase(model.particles());
    std::vector<Vec3<Real>> rest(model.rest_position.size());
    for (int i = 0; i < model.particles(); ++i) {
        inverse_mass[number_of_[i]] = static_cast<Real>(model.inverse_mass[i]);
        phase[number_of_[i]] = model.phase[i];
        if (!rest.empty()) rest[number_of_[i]] = vec3<Real>(model.rest_position[i]);
    }
    view_.inverse_mass = keep(inverse_mass_, inverse_mass);
    view_.phase = keep(phase_, phase);
    view_.rest_position = keep(rest_position_, rest);
}

template <class Real>
void DeviceModel<Real>::set_water(const Model& model) {
    WaterModel<Real>& water = view_.water;
    const double radius = support(model), spacing = model.parameters.fluid_rest_distance;
    const std::vector<double> volumes = particle_volumes(model);
    water.radius = static_cast<Real>(radius);
    water.spacing = static_cast<Real>(spacing);
    water.at_spacing = static_cast<Real>(1 / wendland(spacing, radius));
    water.softening = physics::viscous_softening(water.spacing);
    const double density = fluid_density(model, volumes);
    water.density = static_cast<Real>(density);
    water.dynamic_viscosity = static_cast<Real>(model.parameters.conserving.kinematic_viscosity * density);
    water.max_expansion_rate = static_cast<Real>(max_expansion_rate(model.parameters, solved_depth(model)));
    water.carried = background_pressure<Real>(model);
    water.kernel = physics::wendland_kernel(water.radius, static_cast<Real>(wendland(0, radius)));
    const double reach = effect_radius(model);
    water.effect_radius = static_cast<Real>(reach);
    water.cohesion_strength = static_cast<Real>(model.parameters.cohesion * reach);
    water.cohesion_slope = static_cast<Real>(physics::cohesion_slope(spacing / reach));
    std::vector<Real> volume(model.particles());
    for (int i = 0; i < model.particles(); ++i) volume[number_of_[i]] = static_cast<Real>(volumes[i]);
    water.volume = keep(volume_, volume);
    water.fluid_volume = view_.fluid > 0 ? volume.front() : 0;

    const std::vector<physics::PeriodicAxis<Real>> axes = periodic_axes_of<Real>(model);
    const std::vector<physics::Boundary<Real>> boundaries = boundaries_of<Real>(model);
    water.weight_on_walls = vec3<Real>(model.parameters.buoyancy * gravity_on_walls(model));
    water.periodic_axes = static_cast<int>(axes.size());
    water.boundaries = static_cast<int>(boundaries.size());
    std::copy(axes.begin(), axes.end(), water.periodic_axis);
    std::copy(boundaries.begin(), boundaries.end(), water.boundary);
    water.ghost_transform = keep(ghost_transform_, ghost_transforms(boundaries));
    water.max_copies = max_copies(boundaries, water.radius);
    water.grid = grid_over(model, water.radius, water.radius, cells_off_chip(model));
}

template <class Real>
void DeviceModel<Real>::set_conserving(const Model& model) {
    view_.overlap_acceleration = static_cast<Real>(cpu::overlap_acceleration(model.parameters));
    view_.plane_search_distance += view_.radius;
    std::vector<int> begin{0}, particles;
    for (const std::vector<int>& body : cpu::free_bodies(model)) {
        for (const int i : body) particles.push_back(number_of_[i] - view_.fluid);
        begin.push_back(static_cast<int>(particles.size()));
    }
    view_.free_bodies = static_cast<int>(begin.size()) - 1;
    view_.free_body_begin = keep(free_body_begin_, begin);
    view_.free_body_particle = keep(free_body_particle_, particles);
}

template <class Real>
void DeviceModel<Real>::upload_solids(const Model& model) {
    const auto solid = [this](int i) { return number_of_[i] - view_.fluid; };
    std::vector<std::vector<Incidence>> spring_incidences(view_.solids), cluster_incidences(view_.solids);
    std::vector<SpringView<Real>> springs;
    for (const Spring& spring : model.springs) {
        const int index = static_cast<int>(springs.size());
        const int a = solid(spring.a), b = solid(spring.b);
        if (a < 0 || b < 0) throw InputError("backend cuda: a spring on a fluid particle; must be on solids");
        springs.push_back({a, b, static_cast<Real>(spring.rest_length), physics::SpringRule<Real>(spring)});
        spring_incidences[a].push_back({index, b});
        spring_incidences[b].push_back({index, a});
    }
    std::vector<MuscleView> muscles;
    for (const Muscle& muscle : model.muscles)
        muscles.push_back({muscle.spring, muscle.actuator, model.springs[muscle.spring].rest_length, muscle.lateral});

    std::vector<ClusterView<Real>> clusters;
    std::vector<int> members;
    std::vector<Vec3<Real>> offsets;
    std::vector<Real> masses;
    const bool split = model.scheme != Scheme::flex;
    const std::vector<cpu::SplitCluster<Real>> splits =
        split ? cpu::split_clusters<Real>(model) : std::vector<cpu::SplitCluster<Real>>();
    for (const Cluster& cluster : model.clusters) {
        const int index = static_cast<int>(clusters.size());
        const int begin = static_cast<int>(members.size());
        for (std::size_t m = 0; m < cluster.particles.size(); ++m) {
            const int s = solid(cluster.particles[m]);
            if (s < 0) throw InputError("backend cuda: a cluster with a fluid particle; must be of solids");
            cluster_incidences[s].push_back({index, static_cast<int>(members.size())});
            members.push_back(s);
            if (split) {
                const Vector3<Real>& offset = splits[index].offset[m];
                offsets.push_back({offset.x(), offset.y(), offset.z()});
                masses.push_back(splits[index].mass[m]);
            } else {
                offsets.push_back(vec3<Real>(cluster.rest_offset[m]));
            }
        }
        clusters.push_back({begin, static_cast<int>(members.size()), static_cast<Real>(cluster.stiffness),
                            physics::softness(cluster.stiffness)});
    }
    std::vector<int> body;
    for (const int i : model.body.particles) body.push_back(solid(i));

    const Lists spring_lists(spring_incidences), cluster_lists(cluster_incidences);
    view_.springs = static_cast<int>(springs.size());
    view_.own_springs = own_springs(model);
    view_.muscles = static_cast<int>(muscles.size());
    view_.clusters = static_cast<int>(clusters.size());
    view_.members = static_cast<int>(members.size());
    view_.actuators = model.actuators;
    view_.body = static_cast<int>(body.size());
    view_.tail = model.body.slices.empty() ? 0 : static_cast<int>(model.body.slices.back().size());
    view_.spring = keep(spring_, springs);
    view_.muscle = keep(muscle_, muscles);
    view_.cluster = keep(cluster_, clusters);
    view_.member = keep(member_, members);
    view_.offset = keep(offset_, offsets);
    view_.member_mass = keep(member_mass_, masses);
    view_.spring_incidences_begin = keep(spring_incidences_begin_, spring_lists.begin);
    view_.spring_incidence = keep(spring_incidence_, spring_lists.incidences);
    view_.cluster_incidences_begin = keep(cluster_incidences_begin_, cluster_lists.begin);
    view_.cluster_incidence = keep(cluster_incidence_, cluster_lists.incidences);
    view_.body_particle = keep(body_particle_, body);
}

template <class Real>
GridView<Real> DeviceModel<Real>::grid_over(const Model& model, Real distance, Real margin, int max_cells) const {
    std::array<Real, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::numeric_limits<Real>::max();
        high[axis] = std::numeric_limits<Real>::lowest();
        for (const Eigen::Vector3d& x : model.position) {
            low[axis] = std::min(low[axis], static_cast<Real>(x[axis]));
            high[axis] = std::max(high[axis], static_cast<Real>(x[axis]));
        }
        for (const Plane& plane : model.planes) {
            if (plane.normal[axis] == 1) low[axis] = std::max(low[axis] - view_.radius, Real(-plane.offset));
            if (plane.normal[axis] == -1) high[axis] = std::min(high[axis] + 100 * view_.radius, Real(plane.offset));
        }
        for (const PeriodicAxis& periodic : model.periodic) {
            if (periodic.axis != axis) continue;
            low[axis] = static_cast<Real>(periodic.low);
            high[axis] = static_cast<Real>(periodic.high);
        }
        low[axis] -= margin;
        high[axis] += margin;
    }
    cpu::CellGrid<Real> grid;
    grid.cover(low, high, distance, max_cells);
    const auto box = grid.box();
    GridView<Real> view{};
    for (int axis = 0; axis < 3; ++axis) {
        view.low[axis] = box.low[axis];
        view.size[axis] = 1 / box.inverse_size[axis];
        view.inverse_size[axis] = box.inverse_size[axis];
        view.count[axis] = box.count[axis];
    }
    view.cells = grid.cells();
    return view;
}

/// The tables of the fluid's and the solids' cells, 4 bytes a cell, must fit on the chip beside two buffers of
/// positions where these do.
template <class Real>
int DeviceModel<Real>::cells_on_chip(const Model& model) const {
    constexpr int chip = 223 << 10, elsewhere = 1 << 20;
    const int positions = 2 * model.particles() * static_cast<int>(sizeof(Vec4<Real>));
    return positions < chip - (8 << 10) ? (chip - positions) / 4 : elsewhere / 4;
}

template class DeviceModel<float>;
template class DeviceModel<double>;

}  // namespace natator::cuda
