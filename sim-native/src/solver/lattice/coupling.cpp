#include "coupling.h"

#include <algorithm>
#include <cmath>

namespace natator::lattice {

template <class Real>
Coupling<Real>::Coupling(const Model& model, int threads, std::optional<int> gpu)
    : model_(model),
      threads_(threads),
      gpu_(gpu),
      immersed_(model.position, std::vector<int>(model.position.size(), 0), model.body.spacing, 1.75, surface_offset),
      displaced_(model.water_box->displaced_mass(model.body.spacing)) {}

template <class Real>
std::unique_ptr<Water> Coupling<Real>::make_water() const {
    return gpu_ ? Water::on_gpu(*model_.water_box, *gpu_) : Water::on_cpu(*model_.water_box, threads_);
}

template <class Real>
void Coupling<Real>::begin(const State<Real>& state) {
    water_ = make_water();
    impulses_.assign(state.position.size(), Eigen::Vector3d::Zero());
    fastest_ = 0;
}

template <class Real>
void Coupling<Real>::push(State<Real>& state, double h) {
    if (!water_ || std::abs(state.time - time_) > h / 2) begin(state);
    const bool plane = model_.water_box->is_plane();
    for (std::size_t i = 0; i < impulses_.size(); ++i) {
        Eigen::Vector3d given = impulses_[i] - displaced_ * h * model_.parameters.gravity;
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
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        places_.push_back(state.position[i].template cast<double>());
        velocities_.push_back(state.velocity[i].template cast<double>());
        const double speed = velocities_.back().norm() * per_step;
        if (!(speed > fastest_)) continue;
        fastest_ = speed;
        fastest_particle_ = static_cast<int>(i);
    }
    water_->advance(immersed_.cubes(places_, velocities_, *model_.water_box, h), h, pushes_);
    const std::vector<Eigen::Vector3d> given = immersed_.impulses(pushes_, *model_.water_box, h);
    const double of_size = std::max(1.0, 2 * model_.water_box->cell / model_.body.spacing);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const double kept = of_size * std::max(1.0, displaced_ * model_.inverse_mass[i]);
        impulses_[i] = (given[i] + kept * impulses_[i]) / (1 + kept);
    }
    time_ = time;
    step_ = h;
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
    if (impulses.size() != model_.position.size() || particle < 0 || particle >= model_.particles())
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
    field.velocity.resize(box.cells.cast<std::size_t>().prod(), Eigen::Vector3f::Zero());
    field.density.resize(field.velocity.size(), 1);
    if (!water_ || step_ == 0) return field;
    const auto per_second = static_cast<float>(box.cell / step_);
    std::size_t i = 0;
    for (const Eigen::Vector4f& cell : water_->cells()) {
        field.density[i] = cell[0];
        field.velocity[i++] = per_second * cell.tail<3>();
    }
    return field;
}

template class Coupling<float>;
template class Coupling<double>;

}  // namespace natator::lattice
