#pragma once

#include "conserving_kernels.cuh"
#include "effect_kernels.cuh"

namespace natator::cuda {

inline constexpr int touched_blocks = 32;  ///< what has contacts is little

template <class Real>
struct ConservingLaunches : LaunchEffects<Scheme::conserving, Real> {
    using Base = LaunchEffects<Scheme::conserving, Real>;
    using Base::blocks, Base::iteration, Base::launch, Base::model, Base::slots;
    static constexpr Grouping grouping = Grouping::solids_aside;
    static constexpr bool effects = true;

    void begin_iterations() {
        begin_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
        Base::begin_iterations();
        if (!model.plan.fluid) return;
        mark_one_sided<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
        drop_marked<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
    }
    /// Of the fluid that has contacts.
    void solve_density_constraint() {
        lambda_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
        if (iteration == 0) {
            find_overlap_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
            limit_lambda_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
        }
        if (model.plan.contacts)
            touched_pressure_large<<<launch.grid(touched_blocks), large_threads, 0, launch.stream>>>(model, slots);
    }
    /// Density constraint and planes of the fluid that has no contacts, beside all that is done to solids.
    template <class AfterStage>
    void solve_solids_beside_free_fluid(const AfterStage& after) {
        if (model.solids > 0) {
            solids_large<<<launch.grid(1), threads, 0, launch.part()>>>(model, slots);
            after(Stage::solids);
        }
        if (model.plan.fluid)
            free_pressure_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
        after(Stage::density_constraint);
        if (model.solids > 0) launch.join();
    }
    void update_velocities() {
        constrained_velocities<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
        if (model.free_bodies > 0) body_momentum_large<<<launch.grid(1), threads, 0, launch.part()>>>(model, slots);
        if (model.plan.fluid) {
            rate_lambda_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
            rate_push_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
        }
        if (model.free_bodies > 0) launch.join();
        velocities_in_turn_large<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
    }
};

}  // namespace natator::cuda
