#pragma once

// Forces and losses that the thesis leaves off, between water and water: water/cpu/water_effects.cpp by the whole grid.
// They act on what the viscosity has left in `pushed`. The slots of the fluid are before those of the solids.
#include "physics/water_effects.h"
#include "water_kernels.cuh"

namespace natator::cuda {

/// Normals of the surface and vorticity of the fluid, by all neighbours.
template <Pairs pairs, class Real>
__device__ void measure_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Vec3<Real> v = xyz(water.velocity[s]);
    Vec3<Real> gradients{}, vorticity{};
    for_each_water_pair<pairs>(
        model, slots, s, model.fluid, [&](const Vec3<Real>& gradient, int other, unsigned boundaries) {
            gradients += gradient;
            if (model.vorticity > 0)
                vorticity +=
                    physics::vorticity_part(xyz(reflected(model, water.velocity[other], boundaries)) - v, gradient);
        });
    gradients = sum_of_lanes(gradients);
    vorticity = sum_of_lanes(vorticity);
    if (own_lane() != 0) return;
    const Real volume = water.position[s].w;
    if (model.surface_tension > 0)
        water.normal[s] = quad(physics::colour_normal(gradients, model.water.effect_radius, volume), Real(0));
    if (model.vorticity > 0) {
        vorticity = 1 / volume * vorticity;
        water.vorticity[s] = quad(vorticity, norm(vorticity));
    }
}

/// Free-surface drag, then cohesion, surface tension and vorticity confinement of the fluid.
template <Pairs pairs, class Real>
__device__ void push_water_by_effects(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const WaterModel<Real>& of = model.water;
    const bool cohesive = of.cohesion_strength > 0, tense = model.surface_tension > 0, confined = model.vorticity > 0;
    const Vec3<Real> x = xyz(water.position[s]);
    const Vec3<Real> normal = tense ? xyz(water.normal[s]) : Vec3<Real>{};
    const Vec4<Real> vorticity = confined ? water.vorticity[s] : Vec4<Real>{};
    const Real w = water.velocity[s].w, inverse_radius = 1 / of.effect_radius;
    Vec3<Real> pull{}, tension{}, towards_stronger{};
    if (cohesive || tense || confined)
        for_each_water_pair<pairs>(
            model, slots, s, model.fluid, [&](const Vec3<Real>& gradient, int other, unsigned boundaries) {
                if (other >= model.fluid) return;
                if (confined) towards_stronger += (water.vorticity[other].w - vorticity.w) * gradient;
                const Vec3<Real> difference = x - ghost_position(of, xyz(water.position[other]), boundaries);
                const Real r = norm(difference), its = water.velocity[other].w;
                if (!(r > 0 && r < of.effect_radius)) return;
                if (cohesive) pull += physics::cohesion_part(difference, r, inverse_radius, of.cohesion_slope, w, its);
                if (tense)
                    tension +=
                        physics::tension_part(normal, xyz(reflected(model, water.normal[other], boundaries)), w, its);
            });
    pull = sum_of_lanes(pull);
    tension = sum_of_lanes(tension);
    towards_stronger = sum_of_lanes(towards_stronger);
    if (own_lane() != 0) return;
    const Vec4<Real> pushed = pushed_by_viscosity(model, water, s);
    Vec3<Real> v = physics::dragged(xyz(pushed), water.density[s], slots.h * model.free_surface_drag);
    if (pushed.w > 0) {
        constexpr Real thesis_substep = static_cast<Real>(physics::thesis_substep);
        v -= slots.h / (thesis_substep * thesis_substep) * of.cohesion_strength * pull;
        v -= slots.h * model.surface_tension * tension;
        v += physics::confinement(towards_stronger, xyz(vorticity), slots.h * model.vorticity);
    }
    water.pushed[s] = quad(v, pushed.w);
}

}  // namespace natator::cuda
