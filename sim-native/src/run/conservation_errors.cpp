#include "conservation_errors.h"

#include <algorithm>

#include "natator/measure.h"

namespace natator {

template <class Real>
ConservationErrors conservation_errors(const Model& model, const State<Real>& state,
                                       const std::vector<Real>& densities) {
    const auto share = [](double part, double size) { return size > 0 ? part / size : 0; };
    const Momentum momentum = measure_momentum(model, state, model.body.particles);
    ConservationErrors errors;
    errors.linear_momentum = share(momentum.linear, momentum.linear_size);
    errors.angular_momentum = share(momentum.angular, momentum.angular_size);
    double sum = 0, fluid = 0;
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        const double excess = std::max(static_cast<double>(densities[i]) - 1, 0.0);
        sum += excess;
        fluid += 1;
        errors.density_error_max = std::max(errors.density_error_max, excess);
    }
    errors.density_error_mean = share(sum, fluid);
    return errors;
}

template ConservationErrors conservation_errors(const Model&, const State<float>&, const std::vector<float>&);
template ConservationErrors conservation_errors(const Model&, const State<double>&, const std::vector<double>&);

}  // namespace natator
