#include "coupling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "body_cubes.h"
#include "physics/lattice.h"

namespace natator::lattice {
namespace {

/// Calls visit(body, number) for the swimmer and the others.
template <class Visit>
void for_each_body(const Model& model, const Visit& visit) {
    visit(model.body, 0);
    for (std::size_t k = 0; k < model.companions.size(); ++k) visit(model.companions[k].body, static_cast<int>(k) + 1);
}

std::vector<double> spacings_of(const Model& model) {
    std::vector<double> spacings;
    for_each_body(model,
                  [&](const Body& body, int) { spacings.insert(spacings.end(), body.particles.size(), body.spacing); });
    return spacings;
}

std::vector<double> displaced_by(const Model& model, const std::vector<double>& spacings) {
    std::vector<double> masses;
    masses.reserve(spacings.size());
    for (const double spacing : spacings) masses.push_back(model.water_box->displaced_mass(spacing));
    return masses;
}

Immersed bodies_of(const Model& model, const std::vector<double>& spacings) {
    std::vector<int> bodies;
    for_each_body(model,
                  [&](const Body& body, int number) { bodies.insert(bodies.end(), body.particles.size(), number); });
    const auto end = model.position.begin() + static_cast<std::ptrdiff_t>(bodies.size());
    return {{model.position.begin(), end}, bodies, spacings, 1.75, surface_offset};
}

}  // namespace

CoupledBodies::CoupledBodies(const Model& model)
    : spacing_(spacings_of(model)), displaced_(displaced_by(model, spacing_)), immersed_(bodies_of(model, spacing_)) {
    for (std::size_t i = 0; i < spacing_.size(); ++i) {
        const double of_size = std::max(1.0, 2 * model.water_box->cell / spacing_[i]);
        kept_.push_back(of_size * std::max(1.0, displaced_[i] * model.inverse_mass[i]));
    }
    for (const WaterObstacle& one : model.water_box->obstacles) {
        const std::vector<Cube> own = cubes_of(one.obstacle, *model.water_box);
        cubes_of_obstacles_.push_back(own.size());
        obstacle_cubes_.insert(obstacle_cubes_.end(), own.begin(), own.end());
    }
}

Eigen::Vector3i whole_cells(const Eigen::Vector3d& length, const Box& box) {
    return (length / box.cell).array().round().matrix().cast<int>();
}

void Exchange::save(ByteWriter& to, const Water* water) const {
    to.add(water != nullptr);
    if (!water) return;
    to.add(impulses);
    for (const double value : {time, step, fastest}) to.add(value);
    to.add(fastest_particle);
    water->save(to);
}

bool Exchange::restore(ByteReader from, int particles, const std::function<Water&()>& make) {
    bool has_water = false;
    from.read(has_water);
    if (!has_water) {
        from.require_end();
        return false;
    }
    Exchange read;
    from.read(read.impulses);
    for (double* value : {&read.time, &read.step, &read.fastest}) from.read(*value);
    from.read(read.fastest_particle);
    if (read.impulses.size() != static_cast<std::size_t>(particles) || read.fastest_particle < 0 ||
        read.fastest_particle >= std::max(1, particles) || read.fastest < 0)
        throw InputError("state: its water is not of these bodies");
    make().restore(from);
    *this = std::move(read);
    return true;
}

WaterField field_of(const Box& box, const Water* water, double step) {
    WaterField field;
    field.cells = box.cells;
    field.cell = box.cell;
    field.corner = box.corner;
    field.velocity.resize(box.cells.cast<std::size_t>().prod(), box.current.cast<float>());
    field.density.resize(field.velocity.size(), 1);
    field.pressure.resize(field.velocity.size(), 0);
    if (!water || step == 0) return field;
    const auto per_second = static_cast<float>(box.cell / step);
    const auto stiffness = static_cast<float>(box.density) * per_second * per_second * physics::lattice_sound_squared;
    std::size_t i = 0;
    for (const Eigen::Vector4f& cell : water->cells()) {
        field.density[i] = cell[0];
        field.pressure[i] = stiffness * (cell[0] - 1);
        field.velocity[i++] = per_second * cell.tail<3>();
    }
    return field;
}

template <class Real>
std::vector<Vector3<Real>> mean_forces(const Model& model, const CoupledBodies& bodies,
                                       const std::vector<Eigen::Vector3d>& sums, double time) {
    if (sums.empty()) return {};
    std::vector<Vector3<Real>> mean(model.position.size(), Vector3<Real>::Zero());
    if (!(time > 0)) return mean;
    const std::size_t particles = bodies.displaced().size();
    for (std::size_t i = 0; i < particles; ++i) mean[i] = (sums[i] / time).template cast<Real>();
    auto cube = sums.begin() + static_cast<std::ptrdiff_t>(particles);
    auto particle = mean.begin() + static_cast<std::ptrdiff_t>(particles);
    for (std::size_t k = 0; k < bodies.cubes_of_obstacles().size(); ++k) {
        const auto end = cube + static_cast<std::ptrdiff_t>(bodies.cubes_of_obstacles()[k]);
        const int shared_by = model.water_box->obstacles[k].particles;
        const Eigen::Vector3d sum = std::accumulate(cube, end, Eigen::Vector3d::Zero().eval());
        std::fill_n(particle, shared_by, (sum / std::max(1, shared_by) / time).template cast<Real>().eval());
        cube = end;
        particle += shared_by;
    }
    return mean;
}

template <class Real>
void Coupling<Real>::begin(double h) {
    const Box& box = *model_.water_box;
    water_ = Water::on_cpu(box, threads_);
    exchange_.impulses.assign(bodies_.displaced().size(), Eigen::Vector3d::Zero());
    exchange_.fastest = 0;
    if (!box.current.isZero(0)) water_->set_cells({0, box.current * h / box.cell});
}

template <class Real>
void Coupling<Real>::push(State<Real>& state, double h) {
    if (!water_ || std::abs(state.time - exchange_.time) > h / 2) begin(h);
    const bool plane = model_.water_box->is_plane();
    for (std::size_t i = 0; i < exchange_.impulses.size(); ++i) {
        Eigen::Vector3d given = exchange_.impulses[i] - bodies_.displaced()[i] * h * model_.parameters.gravity;
        if (plane) given.y() = 0;  // not even rounding
        state.velocity[i] += (model_.inverse_mass[i] * given).template cast<Real>();
    }
}

template <class Real>
void Coupling<Real>::shift(const Eigen::Vector3d& by) {
    if (water_) water_->shift(whole_cells(by, *model_.water_box));
}

template <class Real>
void Coupling<Real>::follow(const State<Real>& state, double h, double time) {
    const Box& box = *model_.water_box;
    places_.clear();
    velocities_.clear();
    const double per_step = h / box.cell;
    std::vector<Eigen::Vector3d>& impulses = exchange_.impulses;
    for (std::size_t i = 0; i < impulses.size(); ++i) {
        places_.push_back(state.position[i].template cast<double>());
        velocities_.push_back(state.velocity[i].template cast<double>());
        const double speed = velocities_.back().norm() * per_step;
        if (!(speed > exchange_.fastest)) continue;
        exchange_.fastest = speed;
        exchange_.fastest_particle = static_cast<int>(i);
    }
    std::vector<Cube> cubes = bodies_.immersed().cubes(places_, velocities_, box, h);
    const std::vector<Cube>& obstacles = bodies_.obstacle_cubes();
    cubes.insert(cubes.end(), obstacles.begin(), obstacles.end());
    water_->advance(cubes, h, pushes_);
    const std::vector<Eigen::Vector3d> given = bodies_.immersed().impulses(pushes_, box, h);
    for (std::size_t i = 0; i < given.size(); ++i)
        impulses[i] = running_mean(given[i], bodies_.kept(static_cast<int>(i)), impulses[i]);
    for (std::size_t i = 0; i < forces_.size(); ++i)
        if (i < given.size())
            forces_[i] += given[i] - bodies_.displaced()[i] * h * model_.parameters.gravity;
        else
            forces_[i] += impulse_unit(box, h) * Eigen::Map<const Eigen::Vector3d>(pushes_[i].j);
    force_time_ += h;
    exchange_.time = time;
    exchange_.step = h;
}

template <class Real>
std::optional<int> Coupling<Real>::first_not_finite() const {
    std::size_t push = bodies_.displaced().size();
    auto particle = static_cast<int>(push);
    for (std::size_t k = 0; k < bodies_.cubes_of_obstacles().size(); ++k) {
        for (const std::size_t end = push + bodies_.cubes_of_obstacles()[k]; push < end; ++push)
            if (!Eigen::Map<const Eigen::Vector3d>(pushes_[push].j).allFinite()) return particle;
        particle += model_.water_box->obstacles[k].particles;
    }
    return std::nullopt;
}

template <class Real>
void Coupling<Real>::clear_forces() {
    forces_.assign(bodies_.cubes(), Eigen::Vector3d::Zero());
    force_time_ = 0;
}

template <class Real>
std::vector<Vector3<Real>> Coupling<Real>::forces() const {
    return mean_forces<Real>(model_, bodies_, forces_, force_time_);
}

template <class Real>
void Coupling<Real>::save(ByteWriter& to) const {
    exchange_.save(to, water_.get());
}

template <class Real>
void Coupling<Real>::restore(ByteReader from) {
    std::unique_ptr<Water> made;
    const bool has_water = exchange_.restore(from, bodies_.immersed().particles(), [&]() -> Water& {
        if (!water_) made = Water::on_cpu(*model_.water_box, threads_);
        return made ? *made : *water_;
    });
    if (made) water_ = std::move(made);
    if (has_water) return;
    water_.reset();
    exchange_ = {};
}

template <class Real>
WaterField Coupling<Real>::field() const {
    return field_of(*model_.water_box, water_.get(), exchange_.step);
}

template <class Real>
void Coupling<Real>::visit_cells(const std::function<void(double, const Eigen::Vector3d&)>& visit) const {
    if (!water_ || exchange_.step == 0) return;
    const Box& box = *model_.water_box;
    for (int z = 0; z < box.cells.z(); ++z)
        for (int y = 0; y < box.cells.y(); ++y)
            for (int x = 0; x < box.cells.x(); ++x) {
                const Cell cell = water_->cell({x, y, z});
                visit(1 + cell.excess, cell.velocity * (box.cell / exchange_.step));
            }
}

template class Coupling<float>;
template class Coupling<double>;
template std::vector<Vector3<float>> mean_forces(const Model&, const CoupledBodies&,
                                                 const std::vector<Eigen::Vector3d>&, double);
template std::vector<Vector3<double>> mean_forces(const Model&, const CoupledBodies&,
                                                  const std::vector<Eigen::Vector3d>&, double);

}  // namespace natator::lattice
