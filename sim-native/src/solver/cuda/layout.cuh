#pragma once

#include <algorithm>
#include <limits>

#include "natator/error.h"
#include "state_team.cuh"

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
    unsigned used() const {
        if (used_ > std::numeric_limits<unsigned>::max())
            throw InputError("backend cuda: the scene has more contacts than a block has room for");
        return static_cast<unsigned>(used_);
    }

private:
    std::size_t used_ = 0;
};

/// Has one of so many blocks the solids? Where it has a thread for each, and warps left for fits of clusters, and the
/// others are enough for the fluid, of which none has so much that all had better share it.
template <class Real>
bool splits_solids(const ModelView<Real>& model, TeamKind kind, int blocks) {
    constexpr int min_blocks = 8, max_fluid = 3000;
    const int max_solids = kind == TeamKind::many_blocks ? threads_of(kind) * 3 / 4 : threads_of(kind) / 2;
    if (kind == TeamKind::block || model.fluid > max_fluid * blocks) return false;
    constexpr std::size_t max_bytes = 64 << 10;
    const std::size_t bytes = model.solids * sizeof(Vec4<Real>) + 2 * model.springs * sizeof(ChipSpring<Real>) +
                              model.members * (sizeof(Incidence) + sizeof(Vec4<Real>));
    return blocks >= min_blocks && model.solids > 0 && model.solids <= max_solids && bytes <= max_bytes;
}

/// Slots of the fluid that each block has where threads share them; the last block has none.
template <class Real>
int slots_of_block(const ModelView<Real>& model, int blocks) {
    const int tasks = (model.fluid + shared_slots_of_warp - 1) / shared_slots_of_warp, others = std::max(blocks - 1, 1);
    return (tasks + others - 1) / others * shared_slots_of_warp;
}

/// Layout of the arrays of a team; each block of one of `blocks` has `staging_rows` neighbours' room for each thread on
/// the chip, and one row more for what is no neighbour. Throws InputError for lists that offsets cannot reach.
template <class Real>
Layout layout_of(const ModelView<Real>& model, TeamKind kind, int blocks, std::size_t staging_rows) {
    const bool on_chip = kind == TeamKind::block;
    using Index = typename StateTeam<Real, TeamKind::block>::Index;
    using Word = typename StateTeam<Real, TeamKind::block>::Word;
    const ModelView<Real>& size = model;
    const Plan& plan = model.plan;
    const std::size_t all = model.particles + 1, fluid = model.fluid, solids = model.solids;
    const int threads = threads_of(kind);
    const std::size_t row = threads * sizeof(Index), min_rows = 25;
    Layout at{};
    at.splits_solids = splits_solids(model, kind, blocks);
    const bool shared = kind == TeamKind::many_blocks;
    at.slots_of_block = shared ? slots_of_block(model, blocks) : 0;
    const auto if_shared = [&](std::size_t count) { return shared ? count : 0; };
    const auto if_split = [&](int count) -> std::size_t { return at.splits_solids ? count : 0; };
    const struct {
        std::size_t scratch_position, unsorted, contact_slots, neighbour_counts, cells, neighbours, fluid_contacts,
            solid_contacts, staging;
        std::size_t solids, solid_bounds, spring_incidences, members, clusters;
        std::size_t ranks, chip_cells, chip_slots, chip_contact_slots;
    } room{on_chip ? std::max(all, min_rows * row / sizeof(Vec4<Real>)) : all,
           all,
           all,
           all,
           static_cast<std::size_t>(model.grid.words()),
           fluid * ((model.max_neighbours + 7) / 8),
           plan.contacts ? fluid * solids : 0,
           plan.contacts ? solids * model.particles : 0,
           kind == TeamKind::blocks ? (staging_rows + 1) * threads : 0,
           if_split(model.solids),
           if_split(model.solids + 1),
           if_split(2 * model.springs),
           if_split(model.members),
           if_split(model.clusters),
           if_shared(all),
           if_shared(model.grid.words()),
           if_shared(at.slots_of_block),
           if_shared(max_contact_slots_on_chip)};
    Pieces block_chip, scratch;
    Pieces& team = on_chip ? block_chip : scratch;
#define NATATOR_TAKE(type, name, count, place) at.name = place.template take<type>(count);
    NATATOR_TEAM_ARRAYS(NATATOR_TAKE)
#undef NATATOR_TAKE
    at.chip_bytes = block_chip.used();
    at.scratch_bytes = scratch.used();
    const std::size_t rows = on_chip ? room.scratch_position * sizeof(Vec4<Real>) / row : staging_rows + 1;
    at.staged = static_cast<int>(rows - 1) / 8 * 8;
    return at;
}

}  // namespace natator::cuda
