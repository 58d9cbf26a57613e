#pragma once

// What springs, clusters and planes of scheme conserving go by: in device memory, or on the chip of the block that has
// the solids (chip_solids.cuh). The code of solids.cuh takes either.
#include "solver/cuda/grid/slots.cuh"

namespace natator::cuda {

// X(type, name, how many), see arrays.cuh. Of the Model.
#define NATATOR_SOLID_MODEL_ARRAYS(X)                 \
    X(SpringView<Real>, spring, size.springs)         \
    X(int, spring_incidences_begin, size.solids + 1)  \
    X(Incidence, spring_incidence, 2 * size.springs)  \
    X(ClusterView<Real>, cluster, size.clusters)      \
    X(int, member, size.members)                      \
    X(Vec3<Real>, offset, size.members)               \
    X(Real, member_mass, size.members)                \
    X(int, cluster_incidences_begin, size.solids + 1) \
    X(Incidence, cluster_incidence, size.members)

// Of the State. By place: in device memory a solid's slot, on the chip its number. The first are what iterations
// change.
#define NATATOR_MOVED_SOLID_ARRAYS(X)    \
    X(Vec4<Real>, position, size.solids) \
    X(Vec4<Real>, displacement, size.solids)
#define NATATOR_PLACED_SOLID_ARRAYS(X)             \
    X(Vec4<Real>, predicted_position, size.solids) \
    X(Vec4<Real>, start, size.solids)              \
    X(int, plane_contact, size.solids)

// By solid, spring, member and cluster, what iterations change; what they read, and what is only there within one.
#define NATATOR_CHANGED_SOLID_ARRAYS(X)              \
    X(Vec4<Real>, internal, size.solids)             \
    X(Real, spring_lambda, size.springs)             \
    X(Vec4<Real>, member_displacement, size.members) \
    X(ClusterFit<Real>, fit, size.clusters)
#define NATATOR_KEPT_SOLID_ARRAYS(X) X(Real, rest_length, size.springs)
#define NATATOR_PASSING_SOLID_ARRAYS(X)              \
    X(SpringTerms<Real>, spring_terms, size.springs) \
    X(Vec4<Real>, spring_push, 2 * size.springs)     \
    X(Vec4<Real>, cluster_push, size.members)        \
    X(Real, compliance, size.clusters)               \
    X(ClusterPose, cluster_pose, size.clusters)

#define NATATOR_SOLID_STATE_ARRAYS(X) \
    NATATOR_MOVED_SOLID_ARRAYS(X)     \
    NATATOR_PLACED_SOLID_ARRAYS(X)    \
    NATATOR_CHANGED_SOLID_ARRAYS(X) NATATOR_KEPT_SOLID_ARRAYS(X) NATATOR_PASSING_SOLID_ARRAYS(X)

/// Calls work(k) for k = 0 .. count - 1 by the threads of a block.
template <class Work>
__device__ void for_each_in_block(int count, const Work& work) {
#pragma unroll 1  // it seldom goes round twice
    for (int k = static_cast<int>(threadIdx.x); k < count; k += static_cast<int>(blockDim.x)) work(k);
}

template <class Real>
class SolidsInMemory {
public:
    __device__ SolidsInMemory(const ModelView<Real>& model, const Slots<Real>& slots) : model_(model), slots_(slots) {}

    __device__ int place(int solid) const { return slots_.slot_of_solid()[solid]; }
#define NATATOR_ACCESSOR(type, name, ...) \
    __device__ const type* name() const { return model_.name; }
    NATATOR_SOLID_MODEL_ARRAYS(NATATOR_ACCESSOR)
#undef NATATOR_ACCESSOR
#define NATATOR_ACCESSOR(type, name, ...) \
    __device__ type* name() const { return slots_.name(); }
    NATATOR_SOLID_STATE_ARRAYS(NATATOR_ACCESSOR)
#undef NATATOR_ACCESSOR

private:
    const ModelView<Real>& model_;
    const Slots<Real>& slots_;
};

}  // namespace natator::cuda
