#include "natator/measure.h"
#include "natator/solver.h"
#include "protocol/stream.h"

namespace natator {
namespace {

using nlohmann::ordered_json;

ordered_json vector_json(const Eigen::Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

ordered_json flow_json(const std::vector<SkinFlow>& flow) {
    ordered_json list = ordered_json::array();
    for (const SkinFlow& felt : flow)
        list.push_back({{"velocity", vector_json(felt.velocity)}, {"particles", felt.particles}});
    return list;
}

template <class Real>
ordered_json senses_of(const Simulation<Real>& simulation, const Sensing& sensing, int swimmer) {
    const Model& model = simulation.model();
    const Senses senses = sense(model, simulation.state(), sensing, swimmer);
    ordered_json body;
    body["frame"] = simulation.frames();
    body["time"] = simulation.state().time;
    body["distance"] = simulation.distance(swimmer);
    body["touchesPlane"] = touches_plane(model, simulation.state(), swimmer);
    if (has_muscle_work(model)) body["work"] = simulation.muscle_work(swimmer);
    body["centre"] = vector_json(senses.centre);
    body["forward"] = vector_json(senses.axes.col(0));
    body["up"] = vector_json(senses.axes.col(1));
    body["right"] = vector_json(senses.axes.col(2));
    body["velocity"] = vector_json(senses.velocity);
    body["turnRate"] = vector_json(senses.turn_rate);
    body["drive"] = simulation.driven(swimmer);
    body["bend"] = senses.bend;
    if (!sensing.flow.empty()) body["flow"] = flow_json(senses.flow);
    if (senses.target)
        body["target"] = {{"direction", vector_json(*senses.target)}, {"distance", senses.target_distance}};
    return body;
}

}  // namespace

template <class Real>
ordered_json stream_senses(const Simulation<Real>& simulation, const std::vector<Sensing>& sensing) {
    ordered_json body = senses_of(simulation, sensing.front(), 0);
    for (std::size_t k = 1; k < sensing.size(); ++k)
        body["companions"].push_back(senses_of(simulation, sensing[k], static_cast<int>(k)));
    return body;
}

template ordered_json stream_senses(const Simulation<float>&, const std::vector<Sensing>&);
template ordered_json stream_senses(const Simulation<double>&, const std::vector<Sensing>&);

}  // namespace natator
