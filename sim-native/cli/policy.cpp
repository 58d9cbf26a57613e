#include "policy.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/field.h"
#include "base/strict_json.h"
#include "base/text.h"
#include "natator/error.h"
#include "protocol/stream.h"
#include "scene/gait_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;

constexpr double largest_input = 1000;  // of what is sensed, as in natator.gym
constexpr double largest_offset = 0.5;  // of a gait, as there
constexpr double largest_drive = 2;     // of an actuator
constexpr double largest = 1e6;         // of weights and places

/// Rows of equally many numbers.
Eigen::MatrixXd read_matrix(const json& value, const fields::Place& place) {
    if (!value.is_array() || value.empty() || !value[0].is_array() || value[0].empty())
        fields::refuse(place, "must be rows of numbers");
    Eigen::MatrixXd matrix(value.size(), value[0].size());
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!value[i].is_array() || value[i].size() != value[0].size())
            fields::refuse(place.item(i), "must have as many numbers as the first row");
        for (std::size_t j = 0; j < value[i].size(); ++j)
            fields::read(value[i][j], place.item(i).item(j), {-largest, largest},
                         matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
    return matrix;
}

}  // namespace

Policy::Policy(const std::string& path) {
    const json all = read_json_file(path);
    const fields::Place top{"--policy " + path, ""}, place = top.key("environment");
    fields::check_keys(all, top, {"environment", "layers"});
    const json &environment = fields::required(all, top, "environment"), &layers = fields::required(all, top, "layers");
    if (fields::read_choice<bool>(fields::required(environment, place, "actions"), place.key("actions"),
                                  {{"drive", false}, {"gait", true}}))
        gait_ = read_gait(fields::required(environment, place, "gait"), place.key("gait"));
    fields::read(fields::required(environment, place, "frames"), place.key("frames"), {1, 1000}, frames_);
    const json& flow = fields::required(environment, place, "flow");
    if (!flow.is_array()) fields::refuse(place.key("flow"), flow, "a list of slices and sides");
    for (std::size_t i = 0; i < flow.size(); ++i) {
        const fields::Place at = place.key("flow").item(i);
        if (!flow[i].is_array() || flow[i].size() != 2) fields::refuse(at, flow[i], "a slice and a side");
        sensing_.flow.emplace_back();
        fields::read(flow[i][0], at.item(0), {0, largest}, sensing_.flow.back().slice);
        sensing_.flow.back().side = read_skin_side(flow[i][1], at.item(1));
    }
    if (fields::has(environment, "target")) {
        const Eigen::MatrixXd box = read_matrix(environment["target"], place.key("target"));
        if (box.rows() != 2 || box.cols() != 3) fields::refuse(place.key("target"), "must be two corners of a box");
        low_ = box.row(0);
        high_ = box.row(1);
        sensing_.target = (low_ + high_) / 2;
        fields::read(fields::required(environment, place, "reached"), place.key("reached"), {0, largest}, reached_);
    }
    if (!layers.is_array() || layers.empty()) fields::refuse(top.key("layers"), "must be one layer at least");
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const fields::Place at = top.key("layers").item(i);
        fields::check_keys(layers[i], at, {"weights", "bias"});
        const Eigen::MatrixXd weights = read_matrix(fields::required(layers[i], at, "weights"), at.key("weights"));
        const Eigen::MatrixXd bias =
            read_matrix(json::array({fields::required(layers[i], at, "bias")}), at.key("bias"));
        if (bias.cols() != weights.cols())
            fields::refuse(at.key("bias"), "must have a number for each column of weights");
        if (i > 0 && weights.rows() != layers_.back().bias.size())
            fields::refuse(at.key("weights"), "must have a row for each output of the layer before");
        layers_.push_back({weights.transpose(), bias.transpose()});
    }
    restart();
}

void Policy::check(const Model& model) const {
    check_sensing(sensing_, model);
    if (gait_) {
        check_gait(*gait_, model.actuators);
        for (std::size_t i = 0; i < gait_->amplitude.size(); ++i) {
            const double driven = gait_->amplitude[i] + (gait_->offset.empty() ? 0 : std::abs(gait_->offset[i]));
            if (driven > largest_drive - largest_offset)
                throw InputError("--policy: gait.amplitude[" + std::to_string(i) + "] and the size of its offset are " +
                                 number_text(driven) + " together; must be at most " +
                                 number_text(largest_drive - largest_offset) + ", as actions add up to " +
                                 number_text(largest_offset));
        }
    }
    const auto inputs = static_cast<Eigen::Index>(9 + 2 * model.actuators + 3 * sensing_.flow.size() +
                                                  2 * gait_.has_value() + 4 * sensing_.target.has_value());
    const Eigen::Index outputs = model.actuators * (gait_ ? 2 : 1), has = layers_.front().weights.cols(),
                       acts = layers_.back().bias.size();
    if (has != inputs || acts != outputs)
        throw InputError("--policy: has " + std::to_string(has) + " inputs and " + std::to_string(acts) +
                         " outputs; must have " + std::to_string(inputs) + " and " + std::to_string(outputs) +
                         " for this body");
}

void Policy::restart() {
    frame_ = 0;
    action_ = Eigen::VectorXd::Zero(layers_.back().bias.size());
    if (gait_) action_.head(action_.size() / 2).setOnes();
    before_ = action_;
}

/// As natator.gym observes, in 32 bits.
template <class Real>
Eigen::VectorXd Policy::inputs(const Simulation<Real>& simulation, const Senses& senses) const {
    const double length = simulation.model().body.length;
    std::vector<double> inputs;
    const auto add = [&inputs](const auto& values) { inputs.insert(inputs.end(), values.begin(), values.end()); };
    add(Eigen::Vector3d(senses.velocity / length));
    add(senses.turn_rate);
    add(Eigen::Vector3d(senses.axes.row(1)));
    add(simulation.driven());
    add(senses.bend);
    for (const SkinFlow& felt : senses.flow) add(Eigen::Vector3d(felt.velocity / length));
    if (gait_) {
        const double turns = 2 * std::numbers::pi * gait_->frequency * simulation.time();
        add(std::array{std::sin(turns), std::cos(turns)});
    }
    if (senses.target) {
        add(*senses.target);
        inputs.push_back(senses.target_distance / length);
    }
    return Eigen::Map<Eigen::VectorXd>(inputs.data(), static_cast<Eigen::Index>(inputs.size()))
        .cwiseMax(-largest_input)
        .cwiseMin(largest_input)
        .cast<float>()
        .cast<double>();
}

template <class Real>
Steering Policy::next(const Simulation<Real>& simulation, std::optional<Eigen::Vector3d>& target) {
    const int part = frame_++ % frames_;
    if (part == 0) {
        const Model& model = simulation.model();
        if (sensing_.target) sensing_.target = target.value_or(*sensing_.target);
        Senses senses = sense(model, simulation.state(), sensing_);
        if (senses.target && senses.target_distance <= reached_ * model.body.length) {
            for (int axis = 0; axis < 3; ++axis)
                (*sensing_.target)[axis] =
                    low_[axis] + (high_[axis] - low_[axis]) * static_cast<double>(random_()) / std::mt19937::max();
            target = sensing_.target;
            senses = sense(model, simulation.state(), sensing_);
        }
        Eigen::VectorXd values = inputs(simulation, senses);
        for (const Layer& layer : layers_) {
            values = (layer.weights * values + layer.bias).eval();
            if (&layer != &layers_.back()) values = values.array().tanh().matrix().eval();
        }
        before_ = std::move(action_);
        action_ = values.cwiseMax(-1).cwiseMin(1);
    }
    const Eigen::VectorXd now = before_ + (part + 1.0) / frames_ * (action_ - before_);
    const std::vector<double> values(now.begin(), now.end());
    if (!gait_) return steering_of_drive(values);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    Steering steering{{values.begin(), middle}, {middle, values.end()}};
    for (double& scale : steering.scale) scale = (1 + scale) / 2;
    for (double& offset : steering.offset) offset *= largest_offset;
    return steering;
}

template Steering Policy::next(const Simulation<float>&, std::optional<Eigen::Vector3d>&);
template Steering Policy::next(const Simulation<double>&, std::optional<Eigen::Vector3d>&);

}  // namespace natator::cli
