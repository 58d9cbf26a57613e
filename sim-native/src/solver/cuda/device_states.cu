#include "device_states.h"

#include <algorithm>
#include <cstring>

namespace natator::cuda {
namespace {

float as_quad_number(int i, float) {
    float value;
    std::memcpy(&value, &i, sizeof value);
    return value;
}
double as_quad_number(int i, double) {
    const long long wide = i;
    double value;
    std::memcpy(&value, &wide, sizeof value);
    return value;
}
int number_of(float w) {
    int i;
    std::memcpy(&i, &w, sizeof i);
    return i;
}
int number_of(double w) {
    long long i;
    std::memcpy(&i, &w, sizeof i);
    return static_cast<int>(i);
}

}  // namespace

template <class Real>
DeviceStates<Real>::DeviceStates(const DeviceModel<Real>& model, int count)
    : model_(model),
      count_(count),
      position_(static_cast<std::size_t>(count) * model.view().particles),
      velocity_(position_.size()),
      fit_(static_cast<std::size_t>(count) * model.view().clusters),
      rest_length_(static_cast<std::size_t>(count) * model.view().springs) {}

template <class Real>
void DeviceStates<Real>::upload(const std::vector<State<Real>>& states) {
    std::vector<Vec4<Real>> position, velocity;
    std::vector<ClusterFit<Real>> fits;
    std::vector<Real> rest_lengths;
    for (const State<Real>& state : states) {
        const std::size_t first = position.size();
        position.resize(first + state.position.size());
        velocity.resize(first + state.position.size());
        for (std::size_t i = 0; i < state.position.size(); ++i) {
            const int number = model_.number_of()[i];
            const Vector3<Real>&x = state.position[i], &v = state.velocity[i];
            position[first + number] = {x.x(), x.y(), x.z(), as_quad_number(number, Real())};
            velocity[first + number] = {v.x(), v.y(), v.z(), 0};
        }
        for (std::size_t k = 0; k < state.cluster_centre.size(); ++k) {
            ClusterFit<Real> fit{};
            const Vector3<Real>& centre = state.cluster_centre[k];
            fit.centre = {centre.x(), centre.y(), centre.z()};
            for (int e = 0; e < 4; ++e) fit.rotation[e] = state.cluster_rotation[k].coeffs()[e];
            fits.push_back(fit);
        }
        rest_lengths.insert(rest_lengths.end(), state.spring_rest_length.begin(), state.spring_rest_length.end());
    }
    position_.upload(position);
    velocity_.upload(velocity);
    fit_.upload(fits);
    rest_length_.upload(rest_lengths);
}

namespace {

template <class T>
void copy_rows_on_device(T* to, const T* from, std::size_t size, std::size_t rows) {
    check(cudaMemcpyAsync(to, from, rows * size * sizeof(T), cudaMemcpyDeviceToDevice), "copy");
}

/// Copies row start[k] of `from` to row k of `to`, consecutive rows at once, and of equal ones as many as are there
/// already: a copy takes longer to ask for than to make.
template <class T>
void gather_rows(T* to, const T* from, std::size_t size, const std::vector<int>& start) {
    const std::size_t rows = size > 0 ? start.size() : 0;
    for (std::size_t k = 0, end = 0; k < rows; k = end) {
        const auto ends_with_step = [&](int step) {
            std::size_t at = k + 1;
            while (at < rows && start[at] == start[at - 1] + step) ++at;
            return at;
        };
        const std::size_t consecutive = ends_with_step(1);
        copy_rows_on_device(to + k * size, from + start[k] * size, size, consecutive - k);
        end = std::max(consecutive, ends_with_step(0));
        for (std::size_t made = 1; consecutive == k + 1 && k + made < end; made *= 2)
            copy_rows_on_device(to + (k + made) * size, to + k * size, size, std::min(made, end - k - made));
    }
}

}  // namespace

template <class Real>
void DeviceStates<Real>::copy_from(const DeviceStates& starts, const std::vector<int>& start) {
    const ModelView<Real>& view = model_.view();
    gather_rows(position(), starts.position(), view.particles, start);
    gather_rows(velocity(), starts.velocity(), view.particles, start);
    gather_rows(fit(), starts.fit(), view.clusters, start);
    gather_rows(rest_length_.data(), starts.rest_length(), view.springs, start);
}

template <class Real>
DeviceStates<Real>::Copy::Copy(const DeviceStates& states)
    : states_(states),
      position_(states.position_.size()),
      velocity_(states.velocity_.size()),
      fits_(states.fit_.size()) {}

template <class Real>
void DeviceStates<Real>::Copy::fetch() {
    position_.fetch(states_.position_);
    velocity_.fetch(states_.velocity_);
    fits_.fetch(states_.fit_);
}

template <class Real>
State<Real> DeviceStates<Real>::Copy::state(int k, State<Real> like) const {
    const DeviceModel<Real>& model = states_.model_;
    const std::size_t number = k, particles = model.view().particles, clusters = model.view().clusters;
    const Vec4<Real>* const position = position_.data() + number * particles;
    like.position = by_particle(model, position, position);
    like.velocity = by_particle(model, velocity_.data() + number * particles, position);
    for (std::size_t c = 0; c < clusters; ++c) {
        const ClusterFit<Real>& fit = fits_[number * clusters + c];
        like.cluster_centre[c] = {fit.centre.x, fit.centre.y, fit.centre.z};
        for (int e = 0; e < 4; ++e) like.cluster_rotation[c].coeffs()[e] = fit.rotation[e];
    }
    return like;
}

template <class Real>
std::vector<Vector3<Real>> by_particle(const DeviceModel<Real>& model, const Vec4<Real>* rows,
                                       const Vec4<Real>* numbers) {
    const std::vector<int>& particle_of = model.particle_of();
    std::vector<Vector3<Real>> vectors(particle_of.size());
    for (std::size_t s = 0; s < vectors.size(); ++s)
        vectors[particle_of[number_of(numbers[s].w)]] = {rows[s].x, rows[s].y, rows[s].z};
    return vectors;
}

template class DeviceStates<float>;
template class DeviceStates<double>;
template std::vector<Vector3<float>> by_particle(const DeviceModel<float>&, const Vec4<float>*, const Vec4<float>*);
template std::vector<Vector3<double>> by_particle(const DeviceModel<double>&, const Vec4<double>*, const Vec4<double>*);

}  // namespace natator::cuda
