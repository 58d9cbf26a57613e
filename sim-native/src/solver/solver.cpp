#include "natator/solver.h"

#include <string_view>

#include "cpu/flex/flex_stages.h"
#include "natator/actuate.h"
#include "step.h"

namespace natator {
namespace {

/// Runs the substep once more from the unchanged state and looks behind each stage for the first bad particle.
template <class Real>
Instability locate_instability(cpu::FlexStages<Real>& stages, const Model& model, double time) {
    Instability found;
    bool located = false;
    const auto look = [&](const char* stage) {
        if (located) return;
        if (const auto particle = stages.first_not_finite()) {
            found = {*particle, stage, time};
            located = true;
        }
    };
    substep(stages, stages.plan(), model.parameters.numIterations, look);
    return found;
}

}  // namespace

template <class Real>
State<Real> initial_state(const Model& model) {
    State<Real> state;
    for (int i = 0; i < model.particles(); ++i) {
        state.position.push_back(model.position[i].cast<Real>());
        state.velocity.push_back(model.velocity[i].cast<Real>());
    }
    for (const Cluster& cluster : model.clusters) {
        state.cluster_rotation.push_back(cluster.rotation.cast<Real>());
        state.cluster_centre.push_back(cluster.centre.cast<Real>());
    }
    for (const Spring& spring : model.springs)
        state.spring_rest_length.push_back(static_cast<Real>(spring.rest_length));
    return state;
}

template <class Real>
class Solver<Real>::Implementation {
public:
    explicit Implementation(const Model& model) : model_(model), stages_(model) {}

    std::optional<Instability> update(State<Real>& state, double time_step, int substeps,
                                      StepObserver<Real>* observer) {
        if (model_.particles() == 0) return std::nullopt;
        const Real h = static_cast<Real>(time_step) / static_cast<Real>(substeps);
        for (int k = 0; k < substeps; ++k) {
            stages_.begin_substep(state, h);
            if (observer)
                substep(stages_, stages_.plan(), model_.parameters.numIterations, Tell{*observer, stages_});
            else
                substep(stages_, stages_.plan(), model_.parameters.numIterations, [](const char*) {});
            if (!stages_.finite()) return locate_instability(stages_, model_, state.time);
            stages_.commit();
            state.time += time_step / substeps;
            if (observer) observer->substep_ended(state.velocity);
        }
        return std::nullopt;
    }

    std::optional<Instability> frame(State<Real>& state, const Gait& gait) {
        actuate(model_, gait, state.time, state);
        return update(state, model_.time_step, model_.parameters.substeps, nullptr);
    }

    std::vector<Real> densities() { return stages_.densities(); }
    std::vector<int> neighbour_counts() const { return stages_.neighbour_counts(); }

private:
    /// Passes the stages that an observer sees on to it.
    struct Tell {
        StepObserver<Real>& observer;
        const cpu::FlexStages<Real>& stages;
        void operator()(std::string_view stage) const {
            if (stage == "predict") observer.predicted(stages.workspace().predicted_position);
            if (stage != "iteration") return;
            observer.iterated(stages.positions());
        }
    };

    const Model& model_;
    cpu::FlexStages<Real> stages_;
};

template <class Real>
Solver<Real>::Solver(const Model& model) : implementation_(std::make_unique<Implementation>(model)) {}
template <class Real>
Solver<Real>::~Solver() = default;
template <class Real>
Solver<Real>::Solver(Solver&&) noexcept = default;
template <class Real>
Solver<Real>& Solver<Real>::operator=(Solver&&) noexcept = default;

template <class Real>
std::optional<Instability> Solver<Real>::update(State<Real>& state, double time_step, int substeps,
                                                StepObserver<Real>* observer) {
    return implementation_->update(state, time_step, substeps, observer);
}

template <class Real>
std::optional<Instability> Solver<Real>::frame(State<Real>& state, const Gait& gait) {
    return implementation_->frame(state, gait);
}

template <class Real>
std::vector<Real> Solver<Real>::densities() {
    return implementation_->densities();
}

template <class Real>
std::vector<int> Solver<Real>::neighbour_counts() const {
    return implementation_->neighbour_counts();
}

template State<float> initial_state<float>(const Model&);
template State<double> initial_state<double>(const Model&);
template class Solver<float>;
template class Solver<double>;

}  // namespace natator
