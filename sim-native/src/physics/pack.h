// Vectors of numbers, a particle in each lane, in the width of one instruction set. For kernel sources only, which are
// compiled once per set. What a set has of its own is declared here, and defined in pack/, in a file per set.
#pragma once

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#elif defined(NATATOR_NEON)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace natator::physics::inline NATATOR_SET {

#if defined(__AVX512F__)
constexpr int width = 16;
using Ints = __m512i;
#elif defined(__AVX2__)
constexpr int width = 8;
using Ints = __m256i;
#else
constexpr int width = 4;
using Ints = std::int32_t __attribute__((vector_size(4 * width)));
#endif
#if defined(__AVX2__)
constexpr int double_width = 4;  // also with AVX-512, which takes roots and quotients of 8 no faster
#else
constexpr int double_width = 2;
#endif

/// `width` floats, or `double_width` doubles; the operators of the language work on each lane.
using Floats = float __attribute__((vector_size(4 * width)));
using Doubles = double __attribute__((vector_size(8 * double_width)));

template <class Real>
struct PackOf {
    using Type = Floats;
};
template <>
struct PackOf<double> {
    using Type = Doubles;
};
template <>
struct ScalarOf<Floats> {
    using Type = float;
};
template <>
struct ScalarOf<Doubles> {
    using Type = double;
};
/// The lanes of Real that one instruction works on.
template <class Real>
using Pack = typename PackOf<Real>::Type;

/// Four values for each lane.
template <class T>
struct Four {
    T x, y, z, w;
};

// From and to cache-line boundaries, or multiples of a vector behind one.
using FloatsInMemory [[gnu::may_alias]] = Floats;
using DoublesInMemory [[gnu::may_alias]] = Doubles;
inline Floats load(const float* from) {
    return *reinterpret_cast<const FloatsInMemory*>(from);
}
inline Doubles load(const double* from) {
    return *reinterpret_cast<const DoublesInMemory*>(from);
}
inline void store(float* to, Floats value) {
    *reinterpret_cast<FloatsInMemory*>(to) = value;
}
inline void store(double* to, Doubles value) {
    *reinterpret_cast<DoublesInMemory*>(to) = value;
}
inline Floats load_unaligned(const float* from) {
    Floats value;
    __builtin_memcpy(&value, from, sizeof value);
    return value;
}
inline Floats all_lanes(float value) {
    return value - Floats{};
}

// Of each set.

/// a b + c, with one rounding where the set has an instruction for that.
inline Floats fused(Floats a, Floats b, Floats c);
inline Doubles fused(Doubles a, Doubles b, Doubles c);
inline Floats square_root(Floats v);
inline Doubles square_root(Doubles v);
/// v where it is positive, else 0; also for NaN.
inline Floats positive_part(Floats v);
/// v^2 where v is positive, else 0; rounded here, and not fused with what it is added to.
inline Floats positive_square(Floats v);
/// counter + 1 where v is positive.
inline Floats count_positive(Floats counter, Floats v);
/// 1 in the lanes whose bit is set, else 0.
inline Floats ones(unsigned bits);

/// (x, y, z, w) of the particles index[0 .. width) out of an array of such quadruples.
inline Four<Floats> gather(const float* packed, const std::int32_t* index);
inline Four<Doubles> gather(const double* packed, const std::int32_t* index);
/// from[index[k]] in lane k.
inline Floats gather_one(const float* from, const std::int32_t* index);
/// Writes (x, y, z, w) lane by lane.
inline void store_quadruples(float* to, Four<Floats> v);

inline void store(std::int32_t* to, Ints value);
/// Bit per lane: the first `count` lanes, or all, count >= 0.
inline unsigned first_lanes(int count);
/// Bit per lane: 0 < v < limit.
inline unsigned positive_and_below(Floats v, Floats limit);
/// Writes first + k for each chosen lane k, one behind the other, and anything into the rest of `width` entries.
/// Returns their number.
inline int store_chosen(std::int32_t* to, int first, unsigned chosen);
/// from[0 .. count) and the filler behind; reads nothing there.
inline Ints load_first(const std::int32_t* from, int count, std::int32_t filler);
/// Entry k of vector m becomes entry m of vector k.
inline void transpose(Ints (&rows)[width]);

// Doubles by what the compiler makes of vectors; they do as floats do.

inline Doubles positive_part(Doubles v) {
    return v > 0 ? v : Doubles{};
}
inline Doubles count_positive(Doubles counter, Doubles v) {
    return counter + (v > 0 ? Doubles{} + 1 : Doubles{});
}
inline void set_ones(unsigned bits, Doubles& v) {
    for (int lane = 0; lane < double_width; ++lane) v[lane] = static_cast<double>(bits >> lane & 1u);
}
inline void set_ones(unsigned bits, Floats& v) {
    v = ones(bits);
}
inline Doubles gather_one(const double* from, const std::int32_t* index) {
    Doubles v;
    for (int k = 0; k < double_width; ++k) v[k] = from[index[k]];
    return v;
}
inline void store_quadruples(double* to, Four<Doubles> v) {
    for (int lane = 0; lane < double_width; ++lane) {
        double* const quadruple = to + 4 * lane;
        quadruple[0] = v.x[lane];
        quadruple[1] = v.y[lane];
        quadruple[2] = v.z[lane];
        quadruple[3] = v.w[lane];
    }
}

}  // namespace natator::physics::inline NATATOR_SET

#if defined(__AVX512F__)
#include "physics/pack/avx512.h"
#elif defined(__AVX2__)
#include "physics/pack/avx2.h"
#else
#if defined(NATATOR_NEON)
#include "physics/pack/neon.h"
#endif
#include "physics/pack/portable.h"
#endif
