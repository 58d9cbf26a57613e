#include "natator/measure.h"

#include <numeric>

#include "model/check_model.h"

namespace natator {

template <class Real>
Momentum measure_momentum(const Model& model, const State<Real>& state, const std::vector<int>& particles) {
    check_places_and_velocities(model, state);
    check_particles(model, particles);
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double total = 0;
    for (const int i : particles) {
        if (model.inverse_mass[i] == 0) continue;
        centre += state.position[i].template cast<double>() / model.inverse_mass[i];
        total += 1 / model.inverse_mass[i];
    }
    if (total > 0) centre /= total;

    Momentum result;
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
    for (const int i : particles) {
        if (model.inverse_mass[i] == 0) continue;
        const Eigen::Vector3d p = state.velocity[i].template cast<double>() / model.inverse_mass[i];
        const Eigen::Vector3d moment = (state.position[i].template cast<double>() - centre).cross(p);
        linear += p;
        angular += moment;
        result.linear_size += p.norm();
        result.angular_size += moment.norm();
    }
    result.linear = linear.norm();
    result.angular = angular.norm();
    return result;
}

template <class Real>
Eigen::Vector3d centre_velocity(const Model& model, const State<Real>& state, const std::vector<int>& particles) {
    check_places_and_velocities(model, state);
    check_particles(model, particles);
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    double mass = 0;
    for (const int i : particles) {
        if (model.inverse_mass[i] == 0) continue;
        momentum += state.velocity[i].template cast<double>() / model.inverse_mass[i];
        mass += 1 / model.inverse_mass[i];
    }
    return mass > 0 ? Eigen::Vector3d(momentum / mass) : momentum;
}

template <class Real>
Momentum measure_momentum(const Model& model, const State<Real>& state) {
    std::vector<int> all(model.particles());
    std::iota(all.begin(), all.end(), 0);
    return measure_momentum(model, state, all);
}

template Momentum measure_momentum(const Model&, const State<float>&);
template Momentum measure_momentum(const Model&, const State<double>&);
template Momentum measure_momentum(const Model&, const State<float>&, const std::vector<int>&);
template Momentum measure_momentum(const Model&, const State<double>&, const std::vector<int>&);
template Eigen::Vector3d centre_velocity(const Model&, const State<float>&, const std::vector<int>&);
template Eigen::Vector3d centre_velocity(const Model&, const State<double>&, const std::vector<int>&);

}  // namespace natator
