#include "coupling.h"

#include <algorithm>
#include <cmath>

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

template <class Real>
Coupling<Real>::Coupling(const Model& model, int threads, std::optional<int> gpu)
    : model_(model),
      threads_(threads),
      gpu_(gpu),
      spacing_(spacings_of(model)),
      displaced_(displaced_by(model, spacing_)),
      immersed_(bodies_of(model, spacing_)) {
    for (const WaterObstacle& one : model.water_box->obstacles)
        obstacles_.push_back(cubes_of(one.obstacle, *model.water_box));
}

template <class Real>
std::unique_ptr<Water> Coupling<Real>::make_water() const {
    return gpu_ ? Water::on_gpu(*model_.water_box, *gpu_) : Water::on_cpu(*model_.water_box, threads_);
}

template <class Real>
void Coupling<Real>::begin(double h) {
    water_ = make_water();
    impulses_.assign(spacing_.size(), Eigen::Vector3d::Zero());
    fastest_ = 0;
    const Box& box = *model_.water_box;
    if (!box.current.isZero(0)) water_->set_cells({0, box.current * h / box.cell});
}

template <class Real>
void Coupling<Real>::push(State<Real>& state, double h) {
    if (!water_ || std::abs(state.time - time_) > h / 2) begin(h);
    const bool plane = model_.water_box->is_plane();
    for (std::size_t i = 0; i < impulses_.size(); ++i) {
        Eigen::Vector3d given = impulses_[i] - displaced_[i] * h * model_.parameters.gravity;
        if (plane) given.y() = 0;  // not even rounding
        state.velocity[i] += (model_.inverse_mass[i] * given).template cast<Real>();
    }
}

template <class Real>
void Coupling<Real>::shift(const Eigen::Vector3d& by) {
    const Eigen::Vector3d cells = by / model_.water_box->cell;
    if (water_) water_->shift(cells.array().round().matrix().template cast<int>());
}

template <class Real>
void Coupling<Real>::follow(const State<Real>& state, double h, double time) {
    places_.clear();
    velocities_.clear();
    const double per_step = h / model_.water_box->cell;
    for (std::size_t i = 0; i < spacing_.size(); ++i) {
        places_.push_back(state.position[i].template cast<double>());
        velocities_.push_back(state.velocity[i].template cast<double>());
        const double speed = velocities_.back().norm() * per_step;
        if (!(speed > fastest_)) continue;
        fastest_ = speed;
        fastest_particle_ = static_cast<int>(i);
    }
    std::vector<Cube> cubes = immersed_.cubes(places_, velocities_, *model_.water_box, h);
    for (const std::vector<Cube>& obstacle : obstacles_) cubes.insert(cubes.end(), obstacle.begin(), obstacle.end());
    water_->advance(cubes, h, pushes_);
    const std::vector<Eigen::Vector3d> given = immersed_.impulses(pushes_, *model_.water_box, h);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const double of_size = std::max(1.0, 2 * model_.water_box->cell / spacing_[i]);
        const double kept = of_size * std::max(1.0, displaced_[i] * model_.inverse_mass[i]);
        impulses_[i] = (given[i] + kept * impulses_[i]) / (1 + kept);
    }
    if (!forces_.empty()) sum_forces(given, h);
    time_ = time;
    step_ = h;
}

template <class Real>
std::optional<int> Coupling<Real>::first_not_finite() const {
    std::size_t push = spacing_.size();
    auto particle = static_cast<int>(push);
    for (std::size_t k = 0; k < obstacles_.size(); ++k) {
        for (const std::size_t end = push + obstacles_[k].size(); push < end; ++push)
            if (!Eigen::Map<const Eigen::Vector3d>(pushes_[push].j).allFinite()) return particle;
        particle += model_.water_box->obstacles[k].particles;
    }
    return std::nullopt;
}

template <class Real>
void Coupling<Real>::clear_forces() {
    forces_.assign(model_.position.size(), Eigen::Vector3d::Zero());
    force_time_ = 0;
}

/// What an obstacle is given is shared evenly by its particles.
template <class Real>
void Coupling<Real>::sum_forces(const std::vector<Eigen::Vector3d>& given, double h) {
    force_time_ += h;
    for (std::size_t i = 0; i < given.size(); ++i)
        forces_[i] += given[i] - displaced_[i] * h * model_.parameters.gravity;
    std::size_t push = given.size(), particle = push;
    for (std::size_t k = 0; k < obstacles_.size(); ++k) {
        const int particles = model_.water_box->obstacles[k].particles;
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const std::size_t end = push + obstacles_[k].size(); push < end; ++push)
            sum += Eigen::Map<const Eigen::Vector3d>(pushes_[push].j);
        sum *= impulse_unit(*model_.water_box, h) / std::max(1, particles);
        for (const std::size_t end = particle + static_cast<std::size_t>(particles); particle < end; ++particle)
            forces_[particle] += sum;
    }
}

template <class Real>
std::vector<Vector3<Real>> Coupling<Real>::forces() const {
    std::vector<Vector3<Real>> mean;
    for (const Eigen::Vector3d& sum : forces_)
        mean.push_back(force_time_ > 0 ? (sum / force_time_).template cast<Real>().eval()
                                       : Vector3<Real>::Zero().eval());
    return mean;
}

template <class Real>
void Coupling<Real>::save(ByteWriter& to) const {
    to.add(water_ != nullptr);
    if (!water_) return;
    to.add(impulses_);
    for (const double value : {time_, step_, fastest_}) to.add(value);
    to.add(fastest_particle_);
    water_->save(to);
}

template <class Real>
void Coupling<Real>::restore(ByteReader from) {
    bool has_water = false;
    from.read(has_water);
    if (!has_water) {
        from.require_end();
        water_.reset();
        return;
    }
    std::vector<Eigen::Vector3d> impulses;
    double time = 0, step = 0, fastest = 0;
    int particle = 0;
    from.read(impulses);
    for (double* value : {&time, &step, &fastest}) from.read(*value);
    from.read(particle);
    if (impulses.size() != spacing_.size() || particle < 0 || particle >= model_.particles())
        throw InputError("state: its water is not of these bodies");
    std::unique_ptr<Water> made = water_ ? nullptr : make_water();
    (made ? made : water_)->restore(from);
    if (made) water_ = std::move(made);
    impulses_ = std::move(impulses);
    time_ = time;
    step_ = step;
    fastest_ = fastest;
    fastest_particle_ = particle;
}

template <class Real>
WaterField Coupling<Real>::field() const {
    const Box& box = *model_.water_box;
    WaterField field;
    field.cells = box.cells;
    field.cell = box.cell;
    field.corner = box.corner;
    field.velocity.resize(box.cells.cast<std::size_t>().prod(), box.current.cast<float>());
    field.density.resize(field.velocity.size(), 1);
    field.pressure.resize(field.velocity.size(), 0);
    if (!water_ || step_ == 0) return field;
    const auto per_second = static_cast<float>(box.cell / step_);
    const auto stiffness = static_cast<float>(box.density) * per_second * per_second * physics::lattice_sound_squared;
    std::size_t i = 0;
    for (const Eigen::Vector4f& cell : water_->cells()) {
        field.density[i] = cell[0];
        field.pressure[i] = stiffness * (cell[0] - 1);
        field.velocity[i++] = per_second * cell.tail<3>();
    }
    return field;
}

template class Coupling<float>;
template class Coupling<double>;

}  // namespace natator::lattice
