#include "evaluation_run.h"

#include <numeric>

#include "conservation_errors.h"
#include "natator/measure.h"

namespace natator {
namespace {

/// How far the companions have come from one State to another.
template <class Real>
std::vector<CompanionResult> companion_results(const Scene& scene, const Model& model, const State<Real>& start,
                                               const State<Real>& end) {
    std::vector<CompanionResult> results;
    for (std::size_t k = 0; k < model.companions.size(); ++k) {
        const Body& body = model.companions[k].body;
        const double distance = mean_x(body, end) + end.origin.x() - mean_x(body, start) - start.origin.x();
        results.push_back({scene.companions[k].creature.name, distance, course_of(model, body, end, distance)});
    }
    return results;
}

}  // namespace

EvaluationRun::EvaluationRun(const Scene& scene, const Model& model, const Gait& gait, LawWatch laws)
    : scene_(scene), model_(model), gait_(gait), laws_(std::move(laws)), record_(scene, model) {
    laws_.drive_by(gait);
}

void EvaluationRun::start(const FrameEnd& start) {
    result_.instability = start.instability ? start.instability : laws_.start(start.laws);
    record_.start(start.frame);
}

void EvaluationRun::add(const FrameEnd& end) {
    result_.instability = end.instability;
    result_.cells_per_step = end.cells_per_step;
    if (result_.instability) return;
    work_ = end.work.empty() ? 0 : end.work.front();
    ++result_.frames;
    result_.instability =
        laws_.look(end.laws, std::accumulate(end.work.begin(), end.work.end(), 0.0), result_.frames * scene_.time_step);
    if (result_.instability) return;
    if (const auto over = record_.add(end.frame)) result_.stopped = *over;
}

void EvaluationRun::take(const double* path, int frames, StopReason stopped,
                         const std::optional<Instability>& instability) {
    record_.start({.mean_x = path[0]});
    for (int k = 1; k <= frames; ++k) record_.add({.mean_x = path[k]});
    result_.frames = frames;
    result_.stopped = stopped;
    result_.instability = instability;
}

template <class Real>
Evaluation EvaluationRun::finish(const State<Real>& begin, const State<Real>& end, const std::vector<Real>& densities) {
    result_.hash = state_hash(end);
    if (model_.water_box) result_.smagorinsky = model_.water_box->smagorinsky;
    result_.distance = record_.path().back() - record_.path().front();
    result_.simulated = result_.frames * scene_.time_step;
    if (!result_.instability) {
        result_.errors = conservation_errors(model_, end, densities);
        result_.instability = laws_.look_at_compression(result_.errors.density_error_mean, result_.simulated);
    }
    if (result_.instability) {
        result_.stopped = StopReason::unstable;
        return result_;
    }
    std::vector<double> path = record_.path();
    for (std::size_t k = 0; k < path.size(); ++k)
        path[k] = scene_.through_water(path[k], static_cast<double>(k) * scene_.time_step);
    result_.swimming = swimming_numbers(model_, gait_, scene_.through_water(result_.distance, result_.simulated),
                                        result_.simulated, record_.tail(), path);
    if (result_.swimming) result_.swimming->cavities = cavities(model_, end, densities);
    if (has_muscle_work(model_)) result_.work = work_;
    if (!model_.body.particles.empty()) result_.course = course_of(model_, model_.body, end, result_.distance);
    result_.companions = companion_results(scene_, model_, begin, end);
    record_.write_to(result_);
    return result_;
}

template Evaluation EvaluationRun::finish(const State<float>&, const State<float>&, const std::vector<float>&);
template Evaluation EvaluationRun::finish(const State<double>&, const State<double>&, const std::vector<double>&);

}  // namespace natator
