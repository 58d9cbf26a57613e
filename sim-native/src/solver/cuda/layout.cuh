#pragma once

#include "block.cuh"

namespace natator::cuda {

/// Hands out aligned pieces of one piece of memory; with a null base it only adds up their sizes.
class Pieces {
public:
    __host__ __device__ explicit Pieces(char* base) : base_(base) {}
    template <class T>
    __host__ __device__ T* take(std::size_t count) {
        constexpr std::size_t alignment = 32;
        T* const piece = reinterpret_cast<T*>(base_ + used_);
        used_ += (count * sizeof(T) + alignment - 1) / alignment * alignment;
        return piece;
    }
    __host__ __device__ std::size_t used() const { return used_; }

private:
    char* base_;
    std::size_t used_ = 0;
};

/// Positions, and room for the cells' tables and the sort's keys in the second array of them.
template <class Real>
__host__ __device__ void place_positions(const ModelView<Real>& model, Pieces& pieces, Block<Real>& block) {
    const std::size_t table = (2 * model.grid.cells + model.particles) * sizeof(int);
    const std::size_t at_least = (table + sizeof(Quad<Real>) - 1) / sizeof(Quad<Real>);
    const std::size_t particles = model.particles;
    block.position = pieces.take<Quad<Real>>(particles > at_least ? particles : at_least);
    block.next = pieces.take<Quad<Real>>(particles > at_least ? particles : at_least);
    block.compression = pieces.take<Real>(model.fluid);
}

template <class Real>
__host__ __device__ void place_on_chip(const ModelView<Real>& model, bool on_chip, Pieces& pieces, Block<Real>& block) {
    if (on_chip) place_positions(model, pieces, block);
    block.slot_of_solid = pieces.take<std::uint16_t>(model.solids);
    block.rest_length = pieces.take<Real>(model.springs);
    block.fit = pieces.take<ClusterFit<Real>>(model.clusters);
    block.scan = pieces.take<int>(warps);
    block.touched_count = pieces.take<int>(1);
}

template <class Real>
__host__ __device__ void place_in_scratch(const ModelView<Real>& model, bool on_chip, Pieces& pieces,
                                          Block<Real>& block) {
    if (!on_chip) place_positions(model, pieces, block);
    const std::size_t particles = model.particles, fluid = model.fluid, solids = model.solids;
    block.next_velocity = pieces.take<Quad<Real>>(particles);
    block.predicted = pieces.take<Quad<Real>>(particles);
    block.drift = pieces.take<Quad<Real>>(particles);
    block.drift_before = pieces.take<Quad<Real>>(particles);
    block.start = pieces.take<Quad<Real>>(particles);
    block.neighbour = pieces.take<std::uint16_t>(fluid * model.most_neighbours);
    block.neighbour_count = pieces.take<std::uint16_t>(fluid);
    block.fluid_contact = pieces.take<std::uint16_t>(model.plan.contacts ? fluid * solids : 0);
    block.solid_contact = pieces.take<std::uint16_t>(model.plan.contacts ? solids * particles : 0);
    block.contact_count = pieces.take<std::uint16_t>(particles);
    block.plane_contact = pieces.take<std::uint16_t>(particles);
    block.touched = pieces.take<std::uint16_t>(particles);
    block.fit_before = pieces.take<ClusterFit<Real>>(model.clusters);
    if (model.scheme != Scheme::conserving) return;
    block.base = pieces.take<Quad<Real>>(particles);
    block.displacement = pieces.take<Quad<Real>>(particles);
    block.boundary = pieces.take<Quad<Real>>(fluid);
    block.lambda_sum = pieces.take<Real>(fluid);
    block.overlap = pieces.take<Real>(fluid);
    block.overlap_lambda = pieces.take<Real>(fluid);
    block.active = pieces.take<std::uint16_t>(particles);
    block.internal = pieces.take<Quad<Real>>(solids);
    block.spring_push = pieces.take<Quad<Real>>(model.springs);
    block.spring_lambda = pieces.take<Real>(model.springs);
    block.member_displacement = pieces.take<Quad<Real>>(model.members);
    block.member_push = pieces.take<Quad<Real>>(model.members);
    block.motion = pieces.take<BodyMotion>(model.free_bodies);
}

}  // namespace natator::cuda
