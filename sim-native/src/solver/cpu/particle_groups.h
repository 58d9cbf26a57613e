// How kernels go through slots and their fluid neighbours. For kernel sources only, which are compiled once per
// instruction set: everything here is local to the source that includes it.
#pragma once

#include <cstdint>

#include "physics/vec3.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

using namespace physics;

constexpr int lanes = 16;

/// One slot at a time.
template <class R>
struct Single {
    using Real = R;
    using Lane = Real;
    static constexpr int slots = 1;
    static Lane get(const Real* from) { return *from; }
    static void put(Real* to, Lane value) { *to = value; }
    static Lane one_where(unsigned bits) { return static_cast<Real>(bits & 1u); }
    static Four<Lane> gather(const Real* packed, const std::int32_t* index) {
        const Real* const from = packed + 4 * static_cast<std::int64_t>(*index);
        return {from[0], from[1], from[2], from[3]};
    }
    static Lane gather_one(const Real* from, const std::int32_t* index) { return from[*index]; }
    static void put_quadruples(Real* to, const Four<Lane>& v) {
        to[0] = v.x;
        to[1] = v.y;
        to[2] = v.z;
        to[3] = v.w;
    }
};

/// A vector of slots at a time.
template <class R>
struct Vector {
    using Real = R;
    using Lane = Pack<Real>;
    static constexpr int slots = sizeof(Lane) / sizeof(Real);
    static Lane get(const Real* from) { return load(from); }
    static void put(Real* to, Lane value) { store(to, value); }
    static Lane one_where(unsigned bits) {
        Lane v;
        set_ones(bits, v);
        return v;
    }
    static Four<Lane> gather(const Real* packed, const std::int32_t* index) { return physics::gather(packed, index); }
    static Lane gather_one(const Real* from, const std::int32_t* index) { return physics::gather_one(from, index); }
    static void put_quadruples(Real* to, const Four<Lane>& v) { store_quadruples(to, v); }
};

template <class Group, class From>
inline Vec3<typename Group::Lane> get3(const From& from, int slot) {
    return {Group::get(from[0] + slot), Group::get(from[1] + slot), Group::get(from[2] + slot)};
}
template <class Group, class To>
inline void put3(const To& to, int slot, const Vec3<typename Group::Lane>& value) {
    Group::put(to[0] + slot, value.x);
    Group::put(to[1] + slot, value.y);
    Group::put(to[2] + slot, value.z);
}

/// Calls work(first slot) for each group of slots of the view's blocks.
template <class Group, class View, class Work>
inline void for_each_group(const View& view, const Work& work) {
    for (int slot = view.first_block * lanes; slot < view.end_block * lanes; slot += Group::slots) work(slot);
}

/// Calls visit(entry, neighbours of the group, their separations) for each entry of the rows of a group of slots, which
/// begins at `first`.
template <class Group, class View, class Visit>
inline void for_each_neighbour(const View& fluid, int first, const Visit& visit) {
    using Lane = typename Group::Lane;
    const int block = first / lanes, lane = first % lanes;
    const std::int32_t* const neighbour = fluid.neighbour;
    const typename Group::Real* const packed = fluid.packed;
    const Vec3<Lane> x = get3<Group>(fluid.position, first);
    const int end = fluid.row_begin[block + 1];
    for (int row = fluid.row_begin[block]; row < end; ++row) {
        const int entry = row * lanes + lane;
        const Four<Lane> other = Group::gather(packed, neighbour + entry);
        visit(entry, other, x - Vec3<Lane>{other.x, other.y, other.z});
    }
}

/// Lays three arrays out as quadruples (x, y, z, w), also for the far slot.
template <class Group, class View, class Real>
inline void pack_arrays(const View& fluid, const Real* const from[3], const Real* w, Real* to) {
    const auto pack_group = [&](int slot) {
        const Vec3<typename Group::Lane> v = get3<Group>(from, slot);
        Group::put_quadruples(to + 4 * slot, {v.x, v.y, v.z, Group::get(w + slot)});
    };
    for_each_group<Group>(fluid, pack_group);
    if (fluid.first_block == 0) pack_group(fluid.far_slot / Group::slots * Group::slots);
}

}  // namespace
}  // namespace natator::cpu::NATATOR_ISA
