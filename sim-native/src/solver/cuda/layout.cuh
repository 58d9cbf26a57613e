#pragma once

#include <algorithm>

#include "block.cuh"

namespace natator::cuda {

/// Hands out aligned offsets in one piece of memory.
class Pieces {
public:
    template <class T>
    unsigned take(std::size_t count) {
        constexpr std::size_t alignment = 128;
        const std::size_t offset = used_;
        used_ += (count * sizeof(T) + alignment - 1) / alignment * alignment;
        return static_cast<unsigned>(offset);
    }
    unsigned used() const { return static_cast<unsigned>(used_); }

private:
    std::size_t used_ = 0;
};

/// `on_chip` says where positions are kept.
template <class Real>
Layout layout_of(const ModelView<Real>& model, bool on_chip) {
    Layout at{};
    Pieces chip, scratch;
    Pieces& large = on_chip ? chip : scratch;
    const std::size_t particles = model.particles, fluid = model.fluid, solids = model.solids;
    at.position = large.take<Quad<Real>>(particles + 1);
    const std::size_t least_staging = 25 * threads * sizeof(std::uint16_t) / sizeof(Quad<Real>);
    const std::size_t next = std::max(particles + 1, least_staging);
    at.next = large.take<Quad<Real>>(next);
    const std::size_t cells =
        static_cast<std::size_t>(model.grid.cells) * sizeof(std::uint32_t);  // of fluid and solids
    at.table = large.take<char>(cells);
    at.slot_of_solid = chip.take<std::uint16_t>(solids);
    at.rest_length = chip.take<Real>(model.springs);
    at.fit = chip.take<ClusterFit<Real>>(model.clusters);
    at.scan = chip.take<int>(warps);
    at.shared = chip.take<Shared<Real>>(1);

    at.next_velocity = scratch.take<Quad<Real>>(particles);
    at.predicted = scratch.take<Quad<Real>>(particles);
    at.drift = scratch.take<Quad<Real>>(particles);
    at.drift_before = scratch.take<Quad<Real>>(particles);
    at.start = scratch.take<Quad<Real>>(particles + 1);
    at.number = scratch.take<std::uint16_t>(particles);
    at.neighbour = scratch.take<uint4>(fluid * ((model.most_neighbours + 7) / 8));
    at.chunk_count = scratch.take<std::uint16_t>(fluid);
    at.fluid_contact = scratch.take<std::uint16_t>(model.plan.contacts ? fluid * solids : 0);
    at.solid_contact = scratch.take<std::uint16_t>(model.plan.contacts ? solids * particles : 0);
    at.contact_count = scratch.take<std::uint16_t>(particles);
    at.plane_contact = scratch.take<std::uint16_t>(particles);
    at.touched = scratch.take<std::uint16_t>(particles);
    at.contact_push = scratch.take<Quad<Real>>(particles);
    at.fit_before = scratch.take<ClusterFit<Real>>(model.clusters);
    const Plan& plan = model.plan;
    at.density = scratch.take<Real>(plan.free_surface_drag ? fluid : 0);
    at.overlaps = scratch.take<Real>(plan.dissipation ? particles : 0);
    at.normal = scratch.take<Quad<Real>>(plan.surface_tension ? fluid : 0);
    at.curl = scratch.take<Quad<Real>>(plan.vorticity ? fluid : 0);
    at.chip_bytes = chip.used();
    at.scratch_bytes = scratch.used();
    const std::size_t rows = next * sizeof(Quad<Real>) / (threads * sizeof(std::uint16_t));
    at.staged = static_cast<int>(rows - 1) / 8 * 8;  // one row is for what is no neighbour
    return at;
}

}  // namespace natator::cuda
