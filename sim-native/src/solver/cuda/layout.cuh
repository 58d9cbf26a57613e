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

/// `on_chip` says where a team's arrays are.
template <class Real>
Layout layout_of(const ModelView<Real>& model, bool on_chip) {
    using Index = typename Block<Real, true>::Index;
    using Word = typename Block<Real, true>::Word;
    constexpr std::size_t least_rows = 25, own_rows = 41;  // of staging; the last is for what is no neighbour
    const ModelView<Real>& size = model;
    const Plan& plan = model.plan;
    const std::size_t all = model.particles + 1, fluid = model.fluid, solids = model.solids;
    const std::size_t least_staging = least_rows * threads * sizeof(Index) / sizeof(Quad<Real>);
    const struct {
        std::size_t next, cells, neighbours, fluid_contacts, solid_contacts, staging;
    } room{on_chip ? std::max(all, least_staging) : all,
           static_cast<std::size_t>(model.grid.cells),
           fluid * ((model.most_neighbours + 7) / 8),
           plan.contacts ? fluid * solids : 0,
           plan.contacts ? solids * model.particles : 0,
           on_chip ? 0 : own_rows * threads};
    Layout at{};
    Pieces block_chip, scratch;
    Pieces& team = on_chip ? block_chip : scratch;
#define NATATOR_TAKE(type, name, count, place) at.name = place.template take<type>(count);
    NATATOR_TEAM_ARRAYS(NATATOR_TAKE)
#undef NATATOR_TAKE
    at.chip_bytes = block_chip.used();
    at.scratch_bytes = scratch.used();
    const std::size_t rows = on_chip ? room.next * sizeof(Quad<Real>) / (threads * sizeof(Index)) : own_rows;
    at.staged = static_cast<int>(rows - 1) / 8 * 8;
    return at;
}

}  // namespace natator::cuda
