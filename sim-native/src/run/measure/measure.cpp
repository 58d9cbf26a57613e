#include "natator/measure.h"

#include <algorithm>

#include "model/check_model.h"
#include "physics/early_stop.h"

namespace natator {

template <class Real>
double mean_x(const Body& body, const State<Real>& state) {
    if (body.particles.empty()) return 0;
    double sum = 0;
    for (const int particle : body.particles) sum += static_cast<double>(state.position[particle].x());
    return sum / static_cast<double>(body.particles.size());
}

template <class Real>
bool touches_plane(const Model& model, const State<Real>& state, int swimmer) {
    check_places(model, state);
    const std::vector<int>& body = model.body_of(swimmer).particles;
    return std::any_of(model.planes.begin(), model.planes.end(), [&](const Plane& plane) {
        return std::any_of(body.begin(), body.end(), [&](int particle) {
            const double distance = plane.distance(state.position[particle].template cast<double>());
            return physics::touches(distance, model.parameters.collision_distance, plane.offset);
        });
    });
}

template double mean_x(const Body&, const State<float>&);
template double mean_x(const Body&, const State<double>&);
template bool touches_plane(const Model&, const State<float>&, int);
template bool touches_plane(const Model&, const State<double>&, int);

}  // namespace natator
