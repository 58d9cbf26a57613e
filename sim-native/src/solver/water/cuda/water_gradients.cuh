#pragma once

// G_ij of scheme conserving between a slot of the water and its neighbours.
#include "physics/dfsph.h"
#include "water_neighbours.cuh"

namespace natator::cuda {

/// A vector of a neighbour, reflected where that is a ghost behind `boundaries`. w stays as it is.
template <class Real>
__device__ Vec4<Real> reflected(const ModelView<Real>& model, const Vec4<Real>& v, unsigned boundaries) {
    return boundaries == 0 ? v : quad(reflected(model.water.ghost_transform[boundaries], xyz(v)), v.w);
}

template <class Real>
__device__ physics::Symmetric3<Real> correction_of(const Vec4<Real>& correction, const Vec4<Real>& shear) {
    return {correction.x, correction.y, correction.z, correction.w, shear.x, shear.y};
}

/// G_ij of slot s with others, which are given as they are laid out.
template <class Real>
class GradientsOf {
public:
    struct Pair {
        Vec3<Real> gradient;
        Real slope;  ///< of the kernel
    };

    __device__ GradientsOf(const ModelView<Real>& model, const WaterArrays<Real>& water, int s)
        : model_(model), here_(water.position[s]), own_(correction_of(water.correction[s], water.shear[s])) {}

    __device__ Pair with(unsigned boundaries, const Vec4<Real>& there, const Vec4<Real>& correction,
                         const Vec4<Real>& shear) const {
        Vec3<Real> x = xyz(there);
        physics::Symmetric3<Real> its = correction_of(correction, shear);
        if (boundaries != 0) {  // few warps have ghosts
            x = ghost_position(model_.water, x, boundaries);
            its = reflected(model_.water.ghost_transform[boundaries], its);
        }
        const Vec3<Real> difference = xyz(here_) - x;
        const Real slope = model_.water.kernel.slope(physics::length_of(difference));
        return {physics::pair_gradient(difference, slope, here_.w * there.w, own_ + its), slope};
    }
    /// G_ij rounded as a listed PairGradient is.
    __device__ Vec3<Real> kept(unsigned boundaries, const Vec4<Real>& there, const Vec4<Real>& correction,
                               const Vec4<Real>& shear) const {
        Vec3<Real> gradient = with(boundaries, there, correction, shear).gradient;
        PairGradient<Real>::keep(gradient);
        return gradient;
    }

private:
    const ModelView<Real>& model_;
    const Vec4<Real> here_;
    const physics::Symmetric3<Real> own_;
};

/// Calls visit(G_ij, slot, boundaries, values...) for this thread's share of the neighbours of slot s, once gradients
/// are known, with what is at their slots in each of the arrays; as for_each_water_neighbour.
template <Pairs pairs, int batch = 4, class Real, class Visit, class... Value>
__device__ void for_each_water_pair(const ModelView<Real>& model, const Slots<Real>& slots, int s, int end,
                                    const Visit& visit, const Value*... array) {
    const WaterArrays<Real>& water = slots.water;
    if constexpr (pairs == Pairs::listed) {
        for_each_water_entry<batch>(
            slots, s, [&](std::size_t place) { return read_once(water.pair + place); },
            [&](std::size_t, const PairGradient<Real>& gradient, int slot, unsigned boundaries, const Value&... value) {
                visit(gradient.value(), slot, boundaries, value...);
            },
            array...);
    } else {
        const GradientsOf<Real> own(model, water, s);
        for_each_water_neighbour<pairs, batch>(
            model, slots, s, end,
            [&](std::size_t, int slot, unsigned boundaries, const Vec4<Real>& there, const Vec4<Real>& correction,
                const Vec4<Real>& shear, const Value&... value) {
                visit(own.kept(boundaries, there, correction, shear), slot, boundaries, value...);
            },
            water.position, water.correction, water.shear, array...);
    }
}

}  // namespace natator::cuda
