#pragma once

#include <algorithm>
#include <type_traits>

#include "natator/limits.h"
#include "pair_gradient.cuh"
#include "physics/laws.h"
#include "physics/shape_matching.h"
#include "solver/cuda/list_room.h"
#include "solver/cuda/neighbours.cuh"

namespace natator::cuda {

inline constexpr int max_law_blocks = 32;
/// Number of blocks that check the laws of a State, the same for a Model in any batch.
inline int law_blocks(int particles) {
    return std::clamp(particles / 1024, 1, max_law_blocks);
}

/// Values of a State that the kernels of the whole grid share with each other and the host.
template <class Real>
struct GridShared : Shared<Real> {
    unsigned long long bad;  ///< substep << 32 | particle of the first that is not finite; `none_bad` if all are
    unsigned fault;          ///< of scheme lattice: what is wrong in that substep; `fault_of_body` of the others
    int high;                ///< scheme conserving: some density is far above rest in this substep
    int touches;             ///< the body touches a plane
    int rows;                ///< of the water's lists that slots have got in this substep
    ListRoom needed;         ///< as far as there is no room for it, else below 0
    double mean_x;           ///< of the body
    double tail_z;           ///< of its last slice
    double muscle_work[limits::companions + 1];  ///< by swimmer, of the update's substeps so far
    physics::LawMeasures laws[max_law_blocks];   ///< of the particles that a block of threads has looked at
};

/// Pose of a cluster of scheme conserving, in double.
struct ClusterPose {
    Vec3<double> centre;
    physics::Covariance covariance;
    double rotation[9];  ///< matrix, row by row
};

/// Coefficients of a spring of scheme conserving in a substep, see physics::xpbd_spring_push, and the numbers of its
/// incidences.
template <class Real>
struct SpringTerms {
    Real weights, split, compliance;
    int incidence_of_a, incidence_of_b;
};

inline constexpr unsigned fault_mach = 0, fault_of_water = 1, fault_of_body = ~0u;  // of several the first
inline constexpr unsigned long long none_bad = ~0ull;  // all bytes the same, for cudaMemset

// What only the States of a grid have, in device memory: X(type, name, how many), see arrays.cuh. A number is a
// particle's number of the Model.
#define NATATOR_GRID_ARRAYS(X)                                                                                        \
    /* The State, in the order of slots that the last substep left; w: inverse mass, and the number as an integer. */ \
    X(Vec4<Real>, state_position, all)                                                                                \
    X(Vec4<Real>, state_velocity, all)                                                                                \
    /* In the order before slots are numbered. */                                                                     \
    X(int, cell, all)                                                                                                 \
    X(std::uint64_t, keys, all)            /* particle << 32 | slot before, cell by cell */                           \
    X(Vec4<Real>, predicted_position, all) /* by slot */                                                              \
    X(int, contact_row,                                                                                               \
      plan.contacts&& plan.fluid ? size.fluid : 0) /* of the list of a slot with contacts, see ContactRoom */         \
    X(Vec4<Real>, change, plan.dissipation ? all : 0)                                                                 \
    /* Of solids, in scheme conserving. */                                                                            \
    X(int, constraint_count, conserving ? all : 0)                                                                    \
    X(Vec4<Real>, displacement, conserving ? all : 0)                                                                 \
    X(Vec4<Real>, internal, conserving ? size.solids : 0)                                                             \
    X(SpringTerms<Real>, spring_terms, conserving ? size.springs : 0)                                                 \
    X(Vec4<Real>, spring_push, conserving ? 2 * size.springs : 0) /* by incidence, see ModelView::spring_incidence */ \
    X(Real, spring_lambda, conserving ? size.springs : 0)                                                             \
    X(Real, compliance, conserving ? size.clusters : 0)                                                               \
    X(ClusterPose, cluster_pose, conserving ? size.clusters : 0)                                                      \
    X(Vec4<Real>, member_displacement, conserving ? size.members : 0)                                                 \
    X(Vec4<Real>, cluster_push, conserving ? size.members : 0) /* likewise, see ModelView::cluster_incidence */

#define NATATOR_STATE_ARRAYS(X) NATATOR_CHIP_ARRAYS(X) NATATOR_SCRATCH_ARRAYS(X) NATATOR_GRID_ARRAYS(X)

// The neighbours of a slot of the water are dealt out to lists: neighbour k is entry k / water_lists of list k %
// water_lists. A row is such an entry of all lists of some slots, which have as many rows as the longest of their lists
// needs.
inline constexpr int water_lists = pair_lanes, slots_of_row = 16, water_row = slots_of_row * water_lists;
/// More neighbours than most water has at rest, by the kernel's support in spacings: a lattice has 4/3 pi (R/s)^3.
/// Solids and crowds have more.
constexpr int usual_water_neighbours(double support) {
    return static_cast<int>(5 * support * support * support);
}
/// Where a list's entry lies in its slot's part of a row, and which list lies there: bits reversed. A thread that has
/// several lists, side by side, then adds up what threads with one list each would add up first.
__host__ __device__ constexpr int reversed_list(int list) {
    static_assert(water_lists == 8);
    return (list & 1) << 2 | (list & 2) | list >> 2;
}
/// Offset of a slot's neighbour number `neighbour` from the slot's part of its first row.
__device__ inline int place_of(unsigned neighbour) {
    return static_cast<int>(neighbour / water_lists * water_row) +
           reversed_list(static_cast<int>(neighbour % water_lists));
}

// The water of scheme conserving, by slot of the State as the last substep left it, unless said otherwise: first the
// slots of the fluid. An entry is a slot with the set of boundaries that it is the ghost of: boundaries <<
// max_slot_bits | slot.
#define NATATOR_WATER_ARRAYS(X)                                                                                        \
    X(int, table, plan.water ? size.water.grid.cells : 0)        /* ends of the cells */                               \
    X(int, first_row, (water + slots_of_row - 1) / slots_of_row) /* of the slots that share rows */                    \
    X(int, count, water)                                         /* of neighbours */                                   \
    X(Vec4<Real>, position, water)                               /* w: volume */                                       \
    X(Vec4<Real>, velocity, water)                               /* w: inverse mass */                                 \
    X(Vec4<Real>, pushed, water)                    /* the same with the viscosity and effects of the substep */       \
    X(Vec4<Real>, correction, water)                /* L: xx, yy, zz, xy */                                            \
    X(Vec4<Real>, shear, water)                     /* xz, yz; mobility, see physics::mobility; 1 for solids */        \
    X(Vec4<Real>, separation, plan.water ? all : 0) /* velocities that part overlaps; w: inverse mass, 0 for solids */ \
    X(Vec4<Real>, crowding, water)                                                                                     \
    X(Vec4<Real>, zeroth_order_correction,                                                                             \
      0)                         /* in the same place, later: E_j times its zeroth_order_share; w: impulse_sum */      \
    X(Vec4<Real>, zeroth, water) /* sum of G_ij; w: physics::zeroth_order_correction */                                \
    X(Vec4<Real>, normal, size.surface_tension > 0 ? water : 0) /* of the surface, see physics::colour_normal */       \
    X(Vec4<Real>, vorticity, size.vorticity > 0 ? water : 0)    /* w: its norm */                                      \
    X(Real, density, water)                                                                                            \
    X(Real, max_speed_square, water) /* largest |v_j - v_i|^2 */                                                       \
    X(Real, response, water)                                                                                           \
    X(Real, volume, water)                                                                                             \
    X(Real, impulse_sum, water) /* of the substep so far */                                                            \
    X(Real, impulse, water)                                                                                            \
    X(int, slot_before, water) /* by slot of this substep */                                                           \
    X(int, slot_of_solid, plan.water ? size.solids : 0)                                                                \
    X(Vec4<Real>, impulse_on, keeps_forces ? size.solids : 0) /* of the water, in the update so far; by solid */

#define NATATOR_MEMBER(type, name, ...) type* name = nullptr;
template <class Real>
struct StateArrays {
    using Index = int;
    using Word = int;
    NATATOR_STATE_ARRAYS(NATATOR_MEMBER)
    GridShared<Real>* shared = nullptr;
    int* idle = nullptr;  ///< not 0: the State stays as it is
};
template <class Real>
struct WaterArrays {
    NATATOR_WATER_ARRAYS(NATATOR_MEMBER)
    // By themselves, as their room may grow. Of particles and ghosts, cell by cell: boundaries << 58 | number << 32 |
    // slot; their positions, w: the entry as an integer.
    std::uint64_t* keys = nullptr;
    Vec4<Real>* candidate = nullptr;
    // Of neighbour k of slot s at [Slots::water_place(s) + place_of(k)].
    unsigned* neighbour = nullptr;  ///< entries
    PairGradient<Real>* pair = nullptr;
};
#undef NATATOR_MEMBER

/// Contacts that lists have room for; those of slots that have more are searched anew each time. Fluid far from solids
/// has none, so that its lists are in rows that slots take as they turn out to have contacts: entry k of row r at [k *
/// fluid_rows + r]. Slots that find no row left are searched anew, too.
struct ContactRoom {
    int fluid, solid;
    int fluid_rows = 0;

    __host__ __device__ bool holds(int contacts, int row) const { return contacts <= fluid && row < fluid_rows; }
};

/// States as the kernels of the whole grid see them, and one of them: what StateTeam is to the kernel of a batch.
/// The functions of both take either. The y of the grid is the State's number.
template <class R>
class Slots {
public:
    using Real = R;
    using Index = typename StateArrays<Real>::Index;
    using Word = typename StateArrays<Real>::Word;
    /// As of a team; these are the threads of a block, of which some functions want one alone.
    __device__ static int thread() { return static_cast<int>(threadIdx.x); }
    __device__ static int size() { return static_cast<int>(blockDim.x); }
    __device__ static void barrier() { __syncthreads(); }
    __device__ static bool any(bool value) { return __syncthreads_or(value); }
    static constexpr bool shares_slots = false;
    __host__ __device__ static constexpr bool shares_solids() { return true; }

#define NATATOR_ACCESSOR(type, name, ...) \
    __device__ type* name() const { return arrays.name; }
    NATATOR_STATE_ARRAYS(NATATOR_ACCESSOR)
#undef NATATOR_ACCESSOR
    __device__ GridShared<Real>& shared() const { return *arrays.shared; }
    __device__ Real* rest_length() const { return rest_lengths; }
    __device__ Vec4<Real>* new_velocity() const { return arrays.state_velocity; }
    __device__ Vec4<Real>* end_position() const { return arrays.state_position; }

    /// State k of those that lie side by side.
    __host__ __device__ Slots state(unsigned k) const {
        Slots own = *this;
        const auto shift = [bytes = k * stride](auto*& array) {
            array = reinterpret_cast<std::remove_reference_t<decltype(array)>>(reinterpret_cast<char*>(array) + bytes);
        };
#define NATATOR_SHIFT(type, name, ...) shift(own.arrays.name);
        NATATOR_STATE_ARRAYS(NATATOR_SHIFT)
#undef NATATOR_SHIFT
#define NATATOR_SHIFT(type, name, ...) shift(own.water.name);
        NATATOR_WATER_ARRAYS(NATATOR_SHIFT)
#undef NATATOR_SHIFT
        own.arrays.shared += k;
        own.arrays.idle += k;
        own.arrays.neighbour = arrays.neighbour + k * list_chunks;
        const std::size_t copies = k * static_cast<std::size_t>(water_room.copies);
        own.water.keys += copies;
        own.water.candidate += copies;
        const std::size_t entries = k * static_cast<std::size_t>(water_room.lists) * water_row;
        own.water.neighbour += entries;
        own.water.pair += entries;
        own.rest_lengths += k * rest_length_stride;
        return own;
    }

    /// Chunks of four slots: chunk c of slot s at [(s / 32 * chunks + c) * 32 + s % 32].
    __device__ unsigned& neighbour_entry(int s, int k) const {
        uint4* const chunk = arrays.neighbour + (static_cast<std::size_t>(s / 32) * chunks + k / 4) * 32 + s % 32;
        return reinterpret_cast<unsigned*>(chunk)[k % 4];
    }

    /// Place of slot s in the first row of the water's lists; its part of the next one is water_row further on.
    __device__ std::size_t water_place(int s) const {
        return static_cast<std::size_t>(water.first_row[s / slots_of_row]) * water_row + s % slots_of_row * water_lists;
    }

    /// Whether the water's neighbours are listed. Else there is no room for that, and every sum searches them.
    __host__ __device__ bool lists_water() const { return water_room.lists > 0; }

    /// Nothing that is not finite goes through further substeps: its cells would hold too many particles.
    __device__ bool failed() const {
        return *arrays.idle || static_cast<int>(arrays.shared->bad >> 32 & 0x7fffffff) < substep;
    }

    StateArrays<Real> arrays{};
    WaterArrays<Real> water{};
    Real* rest_lengths = nullptr;  ///< by spring
    std::size_t stride = 0;        ///< bytes from a State's arrays to the next one's
    std::size_t rest_length_stride = 0;
    std::size_t list_chunks = 0;  ///< of a State's lists in scheme flex
    ContactRoom room{};
    int chunks = 0;         ///< of a list of fluid neighbours
    ListRoom water_room{};  ///< of each State
    Real h = 0;             ///< substep, s
    int substep = 0;
};

/// Tasks of work by the warps of the whole grid.
template <class Real, class Work>
__device__ void for_each_warp_task(const Slots<Real>&, int few, int many, const Work& work) {
    const int warps_of_block = static_cast<int>(blockDim.x) / 32;
    const int first = static_cast<int>(blockIdx.x) * warps_of_block + static_cast<int>(threadIdx.x) / 32;
    for (int task = first; task < few + many; task += static_cast<int>(gridDim.x) * warps_of_block) work(task);
}

/// Calls visit(slot) for the fluid neighbours of fluid slot s, and for the far slot until a chunk is full.
template <class Real, class Visit>
__device__ void for_each_neighbour(const ModelView<Real>&, const Slots<Real>& slots, int s, const Visit& visit) {
    const int chunks = (slots.neighbour_count()[s] + 3) / 4;
    const uint4* chunk = slots.arrays.neighbour + (static_cast<std::size_t>(s / 32) * slots.chunks * 32 + s % 32);
    if (chunks == 0) return;
    uint4 next = *chunk;
    for (int c = 1; c <= chunks; ++c) {
        const uint4 now = next;
        chunk += 32;
        if (c < chunks) next = *chunk;
        visit(static_cast<int>(now.x));
        visit(static_cast<int>(now.y));
        visit(static_cast<int>(now.z));
        visit(static_cast<int>(now.w));
    }
}

template <class Real>
__device__ SlotRun slots_in(const ModelView<Real>& model, const Slots<Real>& slots, bool solids, const CellRun& run) {
    if (run.last < run.first) return {0, 0};
    const int* const table = slots.arrays.table + (solids ? model.grid.cells : 0);
    return {run.first > 0 || solids ? table[run.first - 1] : 0, table[run.last]};
}

template <class Real, class Visit>
__device__ void for_each_contact_of(const ModelView<Real>& model, const Slots<Real>& slots, int s, int first, int step,
                                    const Visit& visit) {
    const int count = slots.contact_count()[s];
    if (count == 0) return;
    const bool fluid = s < model.fluid;
    const int row = fluid ? slots.arrays.contact_row[s] : s - model.fluid;
    if (!(fluid ? slots.room.holds(count, row) : count <= slots.room.solid)) {
        search_contacts(model, slots, s, [&](int k, int other) {
            if (k % step == first) visit(other);
        });
        return;
    }
    const int* const list = (fluid ? slots.arrays.fluid_contact : slots.arrays.solid_contact) + row;
    const std::size_t stride = fluid ? slots.room.fluid_rows : model.solids;
    for (int k = first; k < count; k += step) visit(list[k * stride]);
}

}  // namespace natator::cuda
