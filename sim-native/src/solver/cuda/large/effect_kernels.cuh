#pragma once

// What acts behind the velocities of a large State.
#include "flex_kernels.cuh"
#include "substep.cuh"

namespace natator::cuda {

enum class Effect {
    count_overlaps,
    damp,
    measure_damping,
    apply_change,
    drag,
    measure_fluid,
    push_fluid,
    adhesion,
    restitution,
    sleep,
    check
};

/// Does one of them to every slot.
template <Effect effect, class Real>
__global__ void __launch_bounds__(large_threads)
    effect_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    constexpr bool of_fluid = effect == Effect::drag || effect == Effect::measure_fluid || effect == Effect::push_fluid;
    const int s = own_index();
    if (s >= (of_fluid ? model.fluid : model.particles) || slots.failed()) return;
    if constexpr (effect == Effect::count_overlaps) count_overlaps(model, slots, s);
    if constexpr (effect == Effect::damp) damp(model, slots, s);
    if constexpr (effect == Effect::measure_damping) measure_damping(model, slots, s);
    if constexpr (effect == Effect::apply_change) apply_change<Real>(slots, s);
    if constexpr (effect == Effect::drag) drag(model, slots, s);
    if constexpr (effect == Effect::measure_fluid) measure_fluid(model, slots, s);
    if constexpr (effect == Effect::push_fluid) push_fluid_by_forces(model, slots, s);
    if constexpr (effect == Effect::adhesion) apply_adhesion(model, slots, s);
    if constexpr (effect == Effect::restitution) apply_restitution(model, slots, s);
    if constexpr (effect == Effect::sleep) apply_sleep(model, slots, s);
    if constexpr (effect == Effect::check)
        note_if_bad(slots, s, xyz(slots.end_position()[s]), velocity_of<Real>(slots, s));
}

/// Stages of a substep with their effects.
template <Scheme scheme, class Real>
struct LaunchEffects : LaunchStages<scheme, Real> {
    template <Effect effect>
    void launch_effect() const {
        effect_large<effect>
            <<<this->launch.grid(this->blocks), large_threads, 0, this->launch.stream>>>(this->model, this->slots);
    }
    void begin_iterations() {
        if (this->model.plan.dissipation) launch_effect<Effect::count_overlaps>();
    }
    void damp_contacts() {
        if constexpr (scheme == Scheme::flex) return launch_effect<Effect::damp>();
        launch_effect<Effect::measure_damping>();
        launch_effect<Effect::apply_change>();
    }
    void drag_free_surface() { launch_effect<Effect::drag>(); }
    void apply_fluid_forces() {
        launch_effect<Effect::measure_fluid>();
        launch_effect<Effect::push_fluid>();
    }
    void apply_adhesion() { launch_effect<Effect::adhesion>(); }
    void apply_restitution() { launch_effect<Effect::restitution>(); }
    void apply_sleep() { launch_effect<Effect::sleep>(); }
};

/// Launches a substep.
template <class Stages>
void launch_by(const LargeLaunch<typename Stages::Real>& launch) {
    Stages stages{{{launch}}};
    natator::substep(stages, launch.model.plan, launch.model.iterations, AfterLaunch<Stages>{stages});
    if (launch.model.plan.effects()) stages.template launch_effect<Effect::check>();
    check(cudaGetLastError(), "launch");
}

}  // namespace natator::cuda
