#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "aligned.h"
#include "cell_grid.h"
#include "natator/error.h"
#include "neighbour_kernels.h"
#include "thread_team.h"
#include "workspace.h"

namespace natator::cpu {

/// Adds the runs of slots, out of those that begin at `cell_begin`, with all particles near those of a cell.
/// Returns how many slots they hold.
template <class Real>
int add_runs(const CellGrid<Real>& grid, const typename CellGrid<Real>::Rows& rows, int cell,
             const std::vector<int>& cell_begin, SlotRuns& runs) {
    const auto range = grid.range_around(cell);
    int slots = 0;
    for (int k = 0; k < rows.count; ++k) {
        const int begin = cell_begin[rows.first_cell[k] + range.first];
        const int end = cell_begin[rows.first_cell[k] + range.last + 1];
        runs.begin[runs.count] = begin;  // always written and only sometimes kept: no branch to mispredict
        runs.end[runs.count] = end;
        runs.count += begin != end;
        slots += end - begin;
    }
    return slots;
}

/// Where the neighbours of a cell's particles may be, kept for the particles that follow in the same cell, and the rows
/// of cells for the cells that follow in the same row.
template <class Real>
struct Surroundings {
    int cell = -1;
    SlotRuns runs;
    int slots = 0;  ///< in the runs

    /// The slots of each array, a cell's first by cell, are candidates.
    template <class... CellBegin>
    void go_to(const CellGrid<Real>& grid, int next_cell, const CellBegin&... cell_begin) {
        if (next_cell == cell) return;
        cell = next_cell;
        if (grid.row(cell) != row_) {
            row_ = grid.row(cell);
            rows_ = grid.rows_around(row_);
        }
        runs.count = 0;
        slots = (add_runs(grid, rows_, cell, cell_begin, runs) + ...);
    }

private:
    int row_ = -1;
    typename CellGrid<Real>::Rows rows_;
};

/// Where NeighbourLists::list writes: block b holds rows [row_begin[b], row_begin[b+1]) of 16 slots each (sliced
/// ELLPACK).
struct SlicedRows {
    std::vector<int>& row_begin;             ///< one more than blocks
    AlignedVector<std::int32_t>& neighbour;  ///< grows, and may be longer than the rows need
    std::vector<int>& count;                 ///< neighbours by slot
};

/// Builds lists of neighbours, block by block on all threads, the same for any number of them.
template <class Real>
class NeighbourLists {
public:
    struct Search {
        const Real* position[3];  ///< by slot
        int blocks;               ///< that get lists
        Real distance_squared;    ///< neighbours are nearer
        std::int32_t filler;      ///< slot that unused entries point to
        int min_part;             ///< blocks; fewer are done before another thread is awake
        const NeighbourKernels<Real>* kernels;
    };

    /// cell_of(slot) gives a slot's cell, or -1 for slots without particle, which come last; go_to(Surroundings, cell)
    /// goes there. choose(slot, found, n) drops those that do not count and returns how many are left. Returns the
    /// number of entries in all rows.
    template <class CellOf, class GoTo, class Choose>
    std::size_t list(const Search& search, ThreadTeam& team, SlicedRows rows, const CellOf& cell_of, const GoTo& go_to,
                     const Choose& choose) {
        rooms_.resize(team.max_parts());
        for (Room& room : rooms_) room.size = 0;
        // The first part of the blocks has its rows written in place, the others into room of their own, to be
        // appended.
        team.for_parts(search.blocks, search.min_part, [&](int part, int begin, int end) {
            list_part(search, begin, end, rooms_[part], part == 0 ? rows.neighbour : rooms_[part].rows, rows, cell_of,
                      go_to, choose);
        });
        std::size_t size = 0;
        for (const Room& room : rooms_) size += room.size;
        if (size > std::numeric_limits<int>::max())
            throw InputError("particles have crowded: " + std::to_string(size) +
                             " neighbours; must be fewer than 2^31");
        if (rows.neighbour.size() < size) rows.neighbour.resize(size + size / 2);
        team.for_parts(search.blocks, search.min_part, [&](int part, int begin, int end) {
            if (part == 0) return;
            std::size_t before = 0;
            for (int k = 0; k < part; ++k) before += rooms_[k].size;
            const Room& room = rooms_[part];
            std::copy_n(room.rows.begin(), room.size, rows.neighbour.begin() + static_cast<std::ptrdiff_t>(before));
            for (int block = begin; block < end; ++block) rows.row_begin[block] += static_cast<int>(before / lanes);
        });
        rows.row_begin[search.blocks] = static_cast<int>(size / lanes);
        return size;
    }

private:
    /// Room for the neighbours of one block, and for the rows of a part of the blocks.
    struct Room {
        std::array<std::vector<std::int32_t>, lanes> found;
        AlignedVector<std::int32_t> rows;
        std::size_t size = 0;  ///< of the rows
    };

    template <class CellOf, class GoTo, class Choose>
    void list_part(const Search& search, int first_block, int end_block, Room& room,
                   AlignedVector<std::int32_t>& all_rows, SlicedRows rows, const CellOf& cell_of, const GoTo& go_to,
                   const Choose& choose) {
        Surroundings<Real> around;
        std::size_t end = 0;
        for (int block = first_block; block < end_block; ++block) {
            std::array<int, lanes> count{};
            std::array<const std::int32_t*, lanes> list{};
            std::array<int, lanes> cell{};
            int used = 0, max_count = 0;
            while (used < lanes && (cell[used] = cell_of(block * lanes + used)) >= 0) ++used;
            for (int lane = 0, found = 1; lane < used; lane += found) {
                go_to(around, cell[lane]);
                found = lane + 1 < used && cell[lane + 1] == cell[lane] ? 2 : 1;
                find(search, block * lanes + lane, found, around, room, &count[lane]);
                for (int k = lane; k < lane + found; ++k) {
                    list[k] = room.found[k].data();
                    count[k] = choose(block * lanes + k, room.found[k].data(), count[k]);
                    rows.count[block * lanes + k] = count[k];
                    max_count = std::max(max_count, count[k]);
                }
            }
            const std::size_t needed = end + static_cast<std::size_t>(round_up_to_block(max_count)) * lanes;
            if (all_rows.size() < needed) all_rows.resize(needed + needed / 2);
            search.kernels->interleave(list.data(), count.data(), max_count, search.filler, all_rows.data() + end);
            rows.row_begin[block] = static_cast<int>(end / lanes);
            end += static_cast<std::size_t>(max_count) * lanes;
        }
        room.size = end;
    }

    /// Looks for the neighbours of `slots` slots of a cell from `slot` on, one or two of one block, in the room of
    /// their lanes.
    static void find(const Search& search, int slot, int slots, const Surroundings<Real>& around, Room& room,
                     int* count) {
        std::int32_t* found[2]{};
        for (int k = 0; k < slots; ++k) {
            std::vector<std::int32_t>& of_lane = room.found[slot % lanes + k];
            if (static_cast<int>(of_lane.size()) < around.slots + lanes) of_lane.resize(2 * around.slots + lanes);
            found[k] = of_lane.data();
        }
        if (slots == 2)
            search.kernels->find_two(search.position, slot, around.runs, search.distance_squared, found, count);
        else
            *count = search.kernels->find(search.position, slot, around.runs, search.distance_squared, found[0]);
    }

    std::vector<Room> rooms_{1};  ///< by part of the blocks
};

}  // namespace natator::cpu
