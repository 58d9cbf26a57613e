#pragma once

#include "conserving_kernels.cuh"
#include "solver/flex/cuda/effect_kernels.cuh"
#include "water_effect_kernels.cuh"
#include "water_force_kernels.cuh"
#include "water_search.cuh"

namespace natator::cuda {

/// The stages of scheme conserving, whose pairs come from lists or searches.
template <Pairs pairs, class Real>
struct ConservingLaunches : LaunchEffects<Scheme::conserving, Real> {
    using Base = LaunchEffects<Scheme::conserving, Real>;
    using Base::blocks, Base::launch, Base::model, Base::slots;
    using Water = WaterArrays<Real>;
    static constexpr Grouping grouping = Grouping::fused;
    static constexpr bool effects = true;
    // Blocks that act on the solids of a State, each on one multiprocessor: small ones leave room for others there.
    static constexpr int few_threads = 256, more_threads = 512, warp_threads = 128;

    template <auto work>
    void each_particle() const {
        launch.template each_particle<work>();
    }
    /// So many blocks of floats shall fit on a multiprocessor: kernels that wait for memory want to be many.
    template <int at_once>
    static constexpr int min_blocks = std::is_same_v<Real, float> ? at_once : 0;

    /// Have all States slots enough for few threads each?
    bool fills_gpu() const {
        constexpr std::size_t filling = 50'000;
        return std::size_t(model.particles) * launch.states > filling;
    }

    template <auto work, int at_once = 0, class... More>
    void each_pair(More... more) const {
        launch.template each_slot<work, pair_lanes, grid_threads, min_blocks<at_once>>(model.particles, more...);
    }
    /// The same by blocks that have what they ask of neighbours, these arrays, on their chip, where there is room for
    /// it and enough to do.
    template <auto work, int at_once, auto... arrays, class... More>
    void each_pair_on_chip(More... more) const {
        if constexpr (pairs == Pairs::listed && std::is_same_v<Real, float>)
            if (fills_gpu() && launch.template each_slot_on_chip<work, pair_lanes, arrays...>(model.particles, more...))
                return;
        each_pair<work, at_once>(more...);
    }
    template <auto work>
    void each_pair_of_fluid() const {
        launch.template each_slot<work, pair_lanes>(model.fluid);
    }
    template <auto work>
    void each_pair_of_solids() const {
        launch.template each_slot<work, pair_lanes>(model.solids);
    }
    template <Pass which>
    void impulses() const {
        if constexpr (pairs == Pairs::searched)
            each_pair<water_impulses<which, pairs, many_lanes, Real>, 4>();
        else
            each_pair_by_lanes<water_impulses<which, pairs, few_lanes, Real>, blocks_of_velocities,
                               water_impulses<which, pairs, many_lanes, Real>, 6>();
    }
    template <Pass which>
    void push_apart() const {
        if constexpr (pairs == Pairs::searched)
            each_pair<push_water_apart<which, pairs, many_lanes, Real>, 4>();
        else
            each_pair_by_lanes<push_water_apart<which, pairs, few_lanes, Real>, blocks_of_impulses,
                               push_water_apart<which, pairs, many_lanes, Real>, 8>();
    }
    /// By few threads for a slot where that is enough to fill the GPU. Each with its own least blocks.
    template <auto by_few, int few_at_once, auto by_many, int many_at_once>
    void each_pair_by_lanes() const {
        if (fills_gpu())
            launch.template each_slot<by_few, few_lanes, grid_threads, min_blocks<few_at_once>>(model.particles);
        else
            launch.template each_slot<by_many, many_lanes, grid_threads, min_blocks<many_at_once>>(model.particles);
    }
    /// Of the passes that most substeps need not: few blocks, as those that find nothing to do cost time, too.
    template <Pass which>
    void rare_pass() const {
        launch.template each_crowded_slot<water_impulses<which, pairs, many_lanes, Real>, many_lanes>(model.particles);
        launch.template each_crowded_slot<push_water_apart<which, pairs, many_lanes, Real>, many_lanes>(
            model.particles);
    }

    /// And their densities.
    void find_water_neighbours() const {
        const int cells = model.water.grid.cells;
        const WaterArrays<Real>& water = slots.water;
        launch.clear(water.table, cells);
        each_particle<begin_water<Real>>();
        launch.add_up(water.table, cells);
        each_particle<scatter_water<Real>>();
        launch.template each_state<order_water<Real>>(blocks);
        if constexpr (pairs == Pairs::searched)
            each_pair<measure_moments<Real>>();
        else
            list_water_neighbours();
    }
    void list_water_neighbours() const {
        const int rows = blocks_for(model.particles, slots_of_row);
        constexpr int few = 192,
                      many = 448;  // neighbours that a list on the chip has room for: fewer let more blocks run at once
        if (usual_water_neighbours(model.water.radius / model.water.spacing) < few * 3 / 4)
            launch.template each_state<find_water_neighbours_on_grid<few, Real>, water_row>(rows);
        else
            launch.template each_state<find_water_neighbours_on_grid<many, Real>, water_row>(rows);
    }
    void compute_water_gradients() const {
        each_pair_on_chip<water_gradients<pairs, Real>, 4, &Water::position, &Water::correction, &Water::shear,
                          &Water::velocity>();
    }
    bool begin_overlap_separation() const { return true; }  // the device knows whether there are any
    void separate_overlaps(int pass) const {
        if (pass == 0)
            rare_pass<Pass::first_separation>();
        else
            rare_pass<Pass::separation>();
    }
    void end_overlap_separation() const {}
    void solve_divergence() const { push_apart<Pass::divergence>(); }
    void add_viscosity() const {
        each_pair_on_chip<water_viscosity<pairs, Real>, 0, &Water::position, &Water::velocity, &Water::shear>();
        if (launch.keeps_forces) each_pair_of_solids<add_viscous_forces<pairs, Real>>();
    }
    void add_fluid_forces() const {
        if (model.plan.surface_tension || model.plan.vorticity) each_pair_of_fluid<measure_water<pairs, Real>>();
        each_pair_of_fluid<push_water_by_effects<pairs, Real>>();
    }
    void predict() const {
        if (!model.plan.water) return launch_predict<Real, Scheme::conserving>(launch);
        launch.clear(slots.arrays.table, 2 * model.grid.cells);
        each_particle<predict_in_water<Real>>();
    }
    void begin_iterations() {
        launch.template each_state<begin_on_grid<Real>>(blocks);
        Base::begin_iterations();
    }
    void compute_density_impulses() const { impulses<Pass::density>(); }
    void apply_density_impulses() const { push_apart<Pass::density>(); }
    void solve_solids_together() const {
        if (model.solids > 2 * more_threads)
            solve_solids<BlockTeam::threads>();
        else if (model.solids > few_threads)
            solve_solids<more_threads>();
        else if (model.solids > 0)
            solve_solids<few_threads>();
    }
    /// By one block, on its chip where there is room for them; contacts read other slots.
    template <int threads>
    void solve_solids() const {
        const SolidLayout layout = layout_of_solids(model);
        if (!model.plan.contacts && launch.has_room_on_chip(layout.bytes))
            launch.template each_state_on_chip<solids_on_chip<Real>, threads>(layout.bytes, layout);
        else
            launch.template each_state<solids_in_memory<Real>, threads>(1);
    }
    void end_water_passes() const {
        each_particle<lay_out_zeroth_order_correction<Real>>();
        each_pair_on_chip<cuda::end_water_passes<pairs, Real>, 6, &Water::position, &Water::zeroth_order_correction>(
            model.planes > 0 && norm(model.water.weight_on_walls) > 0);
    }
    void add_pressure_forces() const {
        if (launch.keeps_forces) each_pair_of_solids<cuda::add_pressure_forces<pairs, Real>>();
    }
    void move_water() const { launch.template each_slot<cuda::move_water<Real>>(model.fluid); }
    void update_velocities() const {
        each_particle<constrained_velocities<Real>>();
        if (model.free_bodies > 0) launch.template each_state<keep_body_momentum<Real>, warp_threads>(1);
        each_particle<final_velocities_on_grid<Real>>();
    }
};

}  // namespace natator::cuda
