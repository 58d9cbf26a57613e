#pragma once

#include "solver/cuda/neighbours.cuh"

namespace natator::cuda {

/// What the kernels of a large State tell each other and the host.
template <class Real>
struct LargeShared : Shared<Real> {
    unsigned long long bad;  ///< substep << 32 | particle of the first that is not finite; `none_bad` if all are
    int high;                ///< scheme conserving: some density of this iteration is far above rest
    int overlapping;         ///< scheme conserving: some particles began this substep overlapping
    int full;                ///< scheme conserving: some neighbour list is full
    int touches;             ///< the body touches a plane
    int most_neighbours;     ///< scheme dfsph: of any particle, also where lists have no room for them
    double mean_x;           ///< of the body
};

inline constexpr unsigned long long none_bad = ~0ull;  // all bytes the same, for cudaMemset

/// The water of scheme dfsph. A slot is a particle's place in the State as the last substep left it, unless said
/// otherwise. An entry is a slot with the set of planes that it is the ghost of: planes << most_slot_bits | slot.
template <class Real>
struct WaterArrays {
    int* table;             ///< ends of the cells
    std::uint64_t* keys;    ///< of particles and ghosts: planes << 58 | particle << 32 | slot, cell by cell
    Quad<Real>* candidate;  ///< positions of particles and ghosts, cell by cell; w: the entry as an integer

    // Entry k of slot s at [(s / 32 * most + k) * 32 + s % 32].
    int most;             ///< entries of a slot that there is room for
    unsigned* neighbour;  ///< entries
    Real* gradient[3];    ///< G_ij
    int* count;           ///< of neighbours

    Quad<Real>* position;               ///< w: volume
    Quad<Real>*velocity, *pushed;       ///< w: inverse mass; `pushed` has the viscosity and gravity of the substep
    Quad<Real>*correction, *shear;      ///< L_i: xx, yy, zz, xy; xz, yz, inverse mass
    Quad<Real>* crowding;               ///< w: largest |v_j - v_i|^2
    Real *density, *response, *target, *impulse;
    Real* density_of;       ///< by particle
    int* count_of;          ///< by particle
    int* slot_before;       ///< by slot of this substep
    int* slot_of_solid;     ///< by solid
};

/// Arrays of a large State in device memory, by slot unless said otherwise; one more slot is far from all others.
template <class Real>
struct SlotArrays {
    // Of the State, in the order of slots that the last substep left.
    Quad<Real>* state_position;  ///< w: inverse mass
    Quad<Real>* state_velocity;  ///< w: the particle's number as an integer
    ClusterFit<Real>* fit;       ///< by cluster

    // In the order before slots are numbered.
    Quad<Real>* predicted;     ///< w: inverse mass
    Quad<Real>* drift_before;  ///< w: the particle's number
    int* cell;

    std::uint64_t* keys;  ///< particle << 32 | slot before, cell by cell
    int* table;           ///< ends of the fluid's cells, then of the solids'
    Quad<Real>*position, *next, *start, *base, *drift;
    int *number, *slot_of_solid;
    uint4* neighbour;  ///< chunks of four slots: chunk c of slot s at [(s / 32 * chunks + c) * 32 + s % 32]
    int* neighbour_count;
    int* fluid_contact;  ///< entry k of slot s at [k * fluid + s]
    int* solid_contact;  ///< entry k of slot s at [k * solids + s - fluid]
    int *contact_count, *plane_contact, *touched;
    Quad<Real>* contact_push;
    Real* rest_length;  ///< by spring
    LargeShared<Real>* shared;

    // Where an effect needs them.
    Real *density, *overlaps;
    Quad<Real>*change, *normal, *curl;

    // Not in scheme flex.
    Quad<Real>*displacement, *boundary;
    Real *lambda, *lambda_sum, *overlap, *overlap_lambda;
    int* active;
    Quad<Real>*internal, *spring_push, *member_displacement, *member_push;
    Real* spring_lambda;
    BodyMotion* motion;

    WaterArrays<Real> water;  ///< scheme dfsph only
};

/// Contacts that lists have room for; those of slots that have more are searched anew each time.
struct ContactRoom {
    int fluid, solid;
};

/// A large State as its kernels see it: what Block is to the kernel of a batch, for a whole grid of blocks. The
/// functions of both take either.
template <class R>
class Slots {
public:
    using Real = R;

    __device__ Quad<Real>* position() const { return at.position; }
    __device__ Quad<Real>* next() const { return at.next; }
    __device__ Real* lambda() const { return at.lambda; }
    __device__ int* slot_of_solid() const { return at.slot_of_solid; }
    __device__ Real* rest_length() const { return at.rest_length; }
    __device__ ClusterFit<Real>* fit() const { return at.fit; }
    __device__ LargeShared<Real>& shared() const { return *at.shared; }
    __device__ Quad<Real>* drift() const { return at.drift; }
    __device__ Quad<Real>* start() const { return at.start; }
    __device__ int* number() const { return at.number; }
    __device__ int* neighbour_count() const { return at.neighbour_count; }
    __device__ int* contact_count() const { return at.contact_count; }
    __device__ int* plane_contact() const { return at.plane_contact; }
    __device__ int* touched() const { return at.touched; }
    __device__ Quad<Real>* contact_push() const { return at.contact_push; }
    __device__ Quad<Real>* base() const { return at.base; }
    __device__ Quad<Real>* displacement() const { return at.displacement; }
    __device__ Quad<Real>* boundary() const { return at.boundary; }
    __device__ Real* lambda_sum() const { return at.lambda_sum; }
    __device__ Real* overlap() const { return at.overlap; }
    __device__ Real* overlap_lambda() const { return at.overlap_lambda; }
    __device__ int* active() const { return at.active; }
    __device__ Quad<Real>* internal() const { return at.internal; }
    __device__ Quad<Real>* spring_push() const { return at.spring_push; }
    __device__ Real* spring_lambda() const { return at.spring_lambda; }
    __device__ Quad<Real>* member_displacement() const { return at.member_displacement; }
    __device__ Quad<Real>* member_push() const { return at.member_push; }
    __device__ BodyMotion* motion() const { return at.motion; }

    __device__ Real* density() const { return at.density; }
    __device__ Real* overlaps() const { return at.overlaps; }
    __device__ Quad<Real>* change() const { return at.change; }
    __device__ Quad<Real>* normal() const { return at.normal; }
    __device__ Quad<Real>* curl() const { return at.curl; }
    __device__ Quad<Real>* new_velocity() const { return at.state_velocity; }
    __device__ Quad<Real>* end_position() const { return at.state_position; }

    __device__ unsigned& neighbour_entry(int s, int k) const {
        uint4* const chunk = at.neighbour + (static_cast<std::size_t>(s / 32) * chunks + k / 4) * 32 + s % 32;
        return reinterpret_cast<unsigned*>(chunk)[k % 4];
    }

    /// Nothing that is not finite goes through further substeps: its cells would hold too many particles.
    __device__ bool failed() const { return static_cast<int>(at.shared->bad >> 32 & 0x7fffffff) < substep; }

    SlotArrays<Real> at{};
    ContactRoom room{};
    int chunks = 0;  ///< of a neighbour list
    Real h = 0;      ///< substep, s
    int substep = 0;
    bool overlapping = false;
};

inline constexpr int large_threads = 256;  ///< of a block

/// Units of work by the warps of the whole grid.
template <class Real, class Work>
__device__ void for_each_unit(const Slots<Real>&, int count, const Work& work) {
    const int warps_of_block = static_cast<int>(blockDim.x) / 32;
    const int first = static_cast<int>(blockIdx.x) * warps_of_block + static_cast<int>(threadIdx.x) / 32;
    for (int unit = first; unit < count; unit += static_cast<int>(gridDim.x) * warps_of_block) work(unit);
}

/// Calls visit(slot) for the fluid neighbours of fluid slot s, and for the far slot until a chunk is full.
template <class Real, class Visit>
__device__ void for_each_neighbour(const ModelView<Real>&, const Slots<Real>& slots, int s, const Visit& visit) {
    const int chunks = (slots.neighbour_count()[s] + 3) / 4;
    const uint4* chunk = slots.at.neighbour + (static_cast<std::size_t>(s / 32) * slots.chunks * 32 + s % 32);
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

/// Calls visit(slot, nearer than the search distance at the predicted positions) for the slots in the cells around x,
/// of the fluid or the solids.
template <class Real, class Visit>
__device__ void for_each_candidate(const ModelView<Real>& model, const Slots<Real>& slots, bool solids,
                                   const Vec3<Real>& x, const Visit& visit) {
    const int* const table = slots.at.table + (solids ? model.grid.cells : 0);
    const Quad<Real>* const places = slots.base();
    const Real distance_squared = model.search_distance * model.search_distance;
    model.grid.for_each_run(x, [&](int first, int last) {
        const int begin = first > 0 || solids ? table[first - 1] : 0, end = table[last];
        for (int other = begin; other < end; ++other) {
            const Vec3<Real> difference = x - xyz(places[other]);
            const Real r2 = dot(difference, difference);
            visit(other, r2 < distance_squared && r2 > 0);
        }
    });
}

/// Calls visit(k, slot) for what slot s is in contact with, in the order of its list.
template <class Real, class Visit>
__device__ int search_contacts(const ModelView<Real>& model, const Slots<Real>& slots, int s, const Visit& visit) {
    const Vec3<Real> x = xyz(slots.base()[s]);
    const int i = slots.number()[s];
    int n = 0;
    for (int solids = s < model.fluid || model.plan.water ? 1 : 0; solids < 2; ++solids)
        for_each_candidate(model, slots, solids == 1, x, [&](int other, bool near) {
            if (!near) return;
            const int j = slots.number()[other];
            if (!collides(model, i, j) && !(model.plan.mutual_contacts && collides(model, j, i))) return;
            visit(n, other);
            ++n;
        });
    return n;
}

template <class Real, class Visit>
__device__ void for_each_contact_of(const ModelView<Real>& model, const Slots<Real>& slots, int s, int first, int step,
                                    const Visit& visit) {
    const bool fluid = s < model.fluid;
    const int count = slots.contact_count()[s];
    if (count > (fluid ? slots.room.fluid : slots.room.solid)) {
        search_contacts(model, slots, s, [&](int k, int other) {
            if (k % step == first) visit(other);
        });
        return;
    }
    const int* const list = fluid ? slots.at.fluid_contact + s : slots.at.solid_contact + (s - model.fluid);
    const std::size_t stride = fluid ? model.fluid : model.solids;
    for (int k = first; k < count; k += step) visit(list[k * stride]);
}

}  // namespace natator::cuda
