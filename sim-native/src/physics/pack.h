// Vectors of numbers, a particle in each lane, in the width of one instruction set. For kernel sources only, which are
// compiled once per set.
#pragma once

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace natator::physics::inline NATATOR_SET {

#if defined(__AVX512F__)
constexpr int width = 16;
#elif defined(__AVX2__)
constexpr int width = 8;
#else
constexpr int width = 4;
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
/// As many lanes of Real as an instruction works on.
template <class Real>
using Pack = typename PackOf<Real>::Type;

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

#if !defined(__AVX512F__)
#if defined(__AVX2__)
using LaneNumber = std::uint8_t;  // a table of 2 KiB instead of 8
#else
using LaneNumber = std::int32_t;
#endif
/// For each set of lanes their numbers, one behind the other, and how many they are.
struct LaneLists {
    LaneNumber lane[1 << width][width];
    std::uint8_t count[1 << width];
};
constexpr LaneLists list_lanes() {
    LaneLists lists{};
    for (int chosen = 0; chosen < 1 << width; ++chosen)
        for (int lane = 0; lane < width; ++lane)
            if (chosen >> lane & 1) lists.lane[chosen][lists.count[chosen]++] = static_cast<LaneNumber>(lane);
    return lists;
}
constexpr LaneLists lane_lists = list_lanes();
#endif

/// Four values for each lane.
template <class T>
struct Four {
    T x, y, z, w;
};

#if defined(__AVX2__)
/// from[index[k]] in lane k.
inline __m128 four_values(const float* from, const std::int32_t* index) {
    return _mm_setr_ps(from[index[0]], from[index[1]], from[index[2]], from[index[3]]);
}
#endif

#if defined(__AVX512F__)

/// a b + c with one rounding.
inline Floats fused(Floats a, Floats b, Floats c) {
    return _mm512_fmadd_ps(a, b, c);
}
inline Floats square_root(Floats v) {
    return _mm512_sqrt_ps(v);
}
/// v where it is positive, else 0; also for NaN.
inline Floats positive_part(Floats v) {
    return _mm512_max_ps(v, _mm512_setzero_ps());
}
/// v^2 where v is positive, else 0; rounded here, and not fused with what it is added to.
inline Floats positive_square(Floats v) {
    return _mm512_maskz_mul_ps(_mm512_cmp_ps_mask(v, _mm512_setzero_ps(), _CMP_GT_OQ), v, v);
}
/// counter + 1 where v is positive.
inline Floats count_positive(Floats counter, Floats v) {
    const __mmask16 positive = _mm512_cmp_ps_mask(v, _mm512_setzero_ps(), _CMP_GT_OQ);
    return _mm512_mask_add_ps(counter, positive, counter, _mm512_set1_ps(1));
}

/// 1 in the lanes whose bit is set, else 0.
inline Floats ones(unsigned bits) {
    return _mm512_maskz_mov_ps(static_cast<__mmask16>(bits), _mm512_set1_ps(1));
}

/// Four particles, 4 lanes apart, as the 128-bit parts of one vector.
inline __m512 four_apart(const float* packed, const std::int32_t* index) {
    const auto particle = [&](int lane) { return _mm_load_ps(packed + 4 * static_cast<std::int64_t>(index[lane])); };
    // Masked broadcasts load without the shuffle unit, which the transposition needs.
    __m512 v = _mm512_castps128_ps512(particle(0));
    v = _mm512_mask_broadcast_f32x4(v, 0x00f0, particle(4));
    v = _mm512_mask_broadcast_f32x4(v, 0x0f00, particle(8));
    return _mm512_mask_broadcast_f32x4(v, 0xf000, particle(12));
}

/// (x, y, z, w) of the particles index[0 .. width) out of an array of such quadruples: one load per particle and a
/// transposition, which is faster than one gather per value.
inline Four<Floats> gather(const float* packed, const std::int32_t* index) {
    const __m512 a = four_apart(packed, index), b = four_apart(packed, index + 1);
    const __m512 c = four_apart(packed, index + 2), d = four_apart(packed, index + 3);
    const __m512d xy_ab = _mm512_castps_pd(_mm512_unpacklo_ps(a, b)),
                  xy_cd = _mm512_castps_pd(_mm512_unpacklo_ps(c, d));
    const __m512d zw_ab = _mm512_castps_pd(_mm512_unpackhi_ps(a, b)),
                  zw_cd = _mm512_castps_pd(_mm512_unpackhi_ps(c, d));
    return {_mm512_castpd_ps(_mm512_unpacklo_pd(xy_ab, xy_cd)), _mm512_castpd_ps(_mm512_unpackhi_pd(xy_ab, xy_cd)),
            _mm512_castpd_ps(_mm512_unpacklo_pd(zw_ab, zw_cd)), _mm512_castpd_ps(_mm512_unpackhi_pd(zw_ab, zw_cd))};
}

/// from[index[k]] in lane k, four lanes apart from the next four: lane after lane of one vector would wait for each other.
inline Floats gather_one(const float* from, const std::int32_t* index) {
    const __m256 low = _mm256_set_m128(four_values(from, index + 4), four_values(from, index));
    const __m256 high = _mm256_set_m128(four_values(from, index + 12), four_values(from, index + 8));
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}

using Ints = __m512i;

inline void store(std::int32_t* to, Ints value) {
    _mm512_store_si512(to, value);
}
/// first, first + 1, ...
inline Ints consecutive(int first) {
    return _mm512_add_epi32(_mm512_set1_epi32(first),
                            _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}
/// Bit per lane: the first `count` lanes, or all, count >= 0.
inline unsigned first_lanes(int count) {
    return _bzhi_u32(0xffff, static_cast<unsigned>(count < width ? count : width));
}
/// Bit per lane: 0 < v < limit.
inline unsigned positive_and_below(Floats v, Floats limit) {
    const __mmask16 below = _mm512_cmp_ps_mask(v, limit, _CMP_LT_OQ);
    return _mm512_mask_cmp_ps_mask(below, v, _mm512_setzero_ps(), _CMP_GT_OQ);
}
/// Writes first + k for each chosen lane k, one behind the other, and anything into the rest of `width` entries. Returns
/// their number.
inline int store_chosen(std::int32_t* to, int first, unsigned chosen) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(chosen), consecutive(first)));
    return __builtin_popcount(chosen);
}
/// from[0 .. count) and the filler behind; reads nothing there.
inline Ints load_first(const std::int32_t* from, int count, std::int32_t filler) {
    const auto wanted = static_cast<__mmask16>(first_lanes(count < 0 ? 0 : count));
    return _mm512_mask_loadu_epi32(_mm512_set1_epi32(filler), wanted, from);
}
/// Entry k of vector m becomes entry m of vector k.
inline void transpose(Ints (&rows)[width]) {
    Ints pairs[width], quads[width];
    for (int k = 0; k < width; k += 2) {
        pairs[k] = _mm512_unpacklo_epi32(rows[k], rows[k + 1]);
        pairs[k + 1] = _mm512_unpackhi_epi32(rows[k], rows[k + 1]);
    }
    for (int k = 0; k < width; k += 4) {  // quads[k + c]: column c of each 128-bit part, of rows k .. k + 3
        quads[k] = _mm512_unpacklo_epi64(pairs[k], pairs[k + 2]);
        quads[k + 1] = _mm512_unpackhi_epi64(pairs[k], pairs[k + 2]);
        quads[k + 2] = _mm512_unpacklo_epi64(pairs[k + 1], pairs[k + 3]);
        quads[k + 3] = _mm512_unpackhi_epi64(pairs[k + 1], pairs[k + 3]);
    }
    for (int c = 0; c < 4; ++c) {
        const Ints even_01 = _mm512_shuffle_i32x4(quads[c], quads[c + 4], 0x88);
        const Ints odd_01 = _mm512_shuffle_i32x4(quads[c], quads[c + 4], 0xdd);
        const Ints even_23 = _mm512_shuffle_i32x4(quads[c + 8], quads[c + 12], 0x88);
        const Ints odd_23 = _mm512_shuffle_i32x4(quads[c + 8], quads[c + 12], 0xdd);
        rows[c] = _mm512_shuffle_i32x4(even_01, even_23, 0x88);
        rows[c + 4] = _mm512_shuffle_i32x4(odd_01, odd_23, 0x88);
        rows[c + 8] = _mm512_shuffle_i32x4(even_01, even_23, 0xdd);
        rows[c + 12] = _mm512_shuffle_i32x4(odd_01, odd_23, 0xdd);
    }
}

/// Writes (x, y, z, w) lane by lane.
inline void store_quadruples(float* to, Four<Floats> v) {
    const __m512 xy_low = _mm512_unpacklo_ps(v.x, v.y), zw_low = _mm512_unpacklo_ps(v.z, v.w);
    const __m512 xy_high = _mm512_unpackhi_ps(v.x, v.y), zw_high = _mm512_unpackhi_ps(v.z, v.w);
    const auto joined = [](__m512 xy, __m512 zw, bool second) {
        const __m512d a = _mm512_castps_pd(xy), b = _mm512_castps_pd(zw);
        return _mm512_castpd_ps(second ? _mm512_unpackhi_pd(a, b) : _mm512_unpacklo_pd(a, b));
    };
    // Quadruple k holds the lanes k, k + 4, k + 8, k + 12.
    const __m512 quadruple[4] = {joined(xy_low, zw_low, false), joined(xy_low, zw_low, true),
                                 joined(xy_high, zw_high, false), joined(xy_high, zw_high, true)};
    for (int k = 0; k < 4; ++k) {
        _mm_store_ps(to + 4 * k, _mm512_castps512_ps128(quadruple[k]));
        _mm_store_ps(to + 4 * (k + 4), _mm512_extractf32x4_ps(quadruple[k], 1));
        _mm_store_ps(to + 4 * (k + 8), _mm512_extractf32x4_ps(quadruple[k], 2));
        _mm_store_ps(to + 4 * (k + 12), _mm512_extractf32x4_ps(quadruple[k], 3));
    }
}

#elif defined(__AVX2__)

/// a b + c with one rounding.
inline Floats fused(Floats a, Floats b, Floats c) {
    return _mm256_fmadd_ps(a, b, c);
}
inline Floats square_root(Floats v) {
    return _mm256_sqrt_ps(v);
}
/// v where it is positive, else 0; also for NaN.
inline Floats positive_part(Floats v) {
    return _mm256_max_ps(v, _mm256_setzero_ps());
}
/// v^2 where v is positive, else 0; rounded here, and not fused with what it is added to.
inline Floats positive_square(Floats v) {
    return _mm256_and_ps(_mm256_cmp_ps(v, _mm256_setzero_ps(), _CMP_GT_OQ), _mm256_mul_ps(v, v));
}
/// counter + 1 where v is positive.
inline Floats count_positive(Floats counter, Floats v) {
    const __m256 positive = _mm256_cmp_ps(v, _mm256_setzero_ps(), _CMP_GT_OQ);
    return counter + _mm256_and_ps(positive, _mm256_set1_ps(1));
}

/// 1 in the lanes whose bit is set, else 0.
inline Floats ones(unsigned bits) {
    const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), bit);
    return _mm256_and_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, bit)), _mm256_set1_ps(1));
}

/// Two particles, 4 lanes apart, as the 128-bit parts of one vector.
inline __m256 two_apart(const float* packed, const std::int32_t* index) {
    const auto particle = [&](int lane) { return _mm_load_ps(packed + 4 * static_cast<std::int64_t>(index[lane])); };
    return _mm256_insertf128_ps(_mm256_castps128_ps256(particle(0)), particle(4), 1);
}

/// (x, y, z, w) of the particles index[0 .. width) out of an array of such quadruples: one load per particle and a
/// transposition, which is faster than one gather per value.
inline Four<Floats> gather(const float* packed, const std::int32_t* index) {
    const __m256 a = two_apart(packed, index), b = two_apart(packed, index + 1);
    const __m256 c = two_apart(packed, index + 2), d = two_apart(packed, index + 3);
    const __m256d xy_ab = _mm256_castps_pd(_mm256_unpacklo_ps(a, b)),
                  xy_cd = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
    const __m256d zw_ab = _mm256_castps_pd(_mm256_unpackhi_ps(a, b)),
                  zw_cd = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
    return {_mm256_castpd_ps(_mm256_unpacklo_pd(xy_ab, xy_cd)), _mm256_castpd_ps(_mm256_unpackhi_pd(xy_ab, xy_cd)),
            _mm256_castpd_ps(_mm256_unpacklo_pd(zw_ab, zw_cd)), _mm256_castpd_ps(_mm256_unpackhi_pd(zw_ab, zw_cd))};
}

/// from[index[k]] in lane k.
inline Floats gather_one(const float* from, const std::int32_t* index) {
    return _mm256_set_m128(four_values(from, index + 4), four_values(from, index));
}

using Ints = __m256i;

inline void store(std::int32_t* to, Ints value) {
    _mm256_store_si256(reinterpret_cast<Ints*>(to), value);
}
/// first, first + 1, ...
inline Ints consecutive(int first) {
    return _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}
/// Bit per lane: the first `count` lanes, or all, count >= 0.
inline unsigned first_lanes(int count) {
    return _bzhi_u32(0xff, static_cast<unsigned>(count < width ? count : width));
}
/// Bit per lane: 0 < v < limit.
inline unsigned positive_and_below(Floats v, Floats limit) {
    const __m256 below = _mm256_cmp_ps(v, limit, _CMP_LT_OQ);
    const __m256 positive = _mm256_cmp_ps(v, _mm256_setzero_ps(), _CMP_GT_OQ);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_and_ps(below, positive)));
}

/// Writes first + k for each chosen lane k, one behind the other, and anything into the rest of `width` entries. Returns
/// their number.
inline int store_chosen(std::int32_t* to, int first, unsigned chosen) {
    const __m128i lanes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(lane_lists.lane[chosen]));
    const Ints numbers = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_cvtepu8_epi32(lanes));
    _mm256_storeu_si256(reinterpret_cast<__m256i_u*>(to), numbers);
    return __builtin_popcount(chosen);
}
/// from[0 .. count) and the filler behind; reads nothing there.
inline Ints load_first(const std::int32_t* from, int count, std::int32_t filler) {
    const Ints wanted = _mm256_cmpgt_epi32(_mm256_set1_epi32(count), consecutive(0));
    return _mm256_blendv_epi8(_mm256_set1_epi32(filler), _mm256_maskload_epi32(from, wanted), wanted);
}
/// Entry k of vector m becomes entry m of vector k.
inline void transpose(Ints (&rows)[width]) {
    Ints pairs[width], quads[width];
    for (int k = 0; k < width; k += 2) {
        pairs[k] = _mm256_unpacklo_epi32(rows[k], rows[k + 1]);
        pairs[k + 1] = _mm256_unpackhi_epi32(rows[k], rows[k + 1]);
    }
    for (int k = 0; k < width; k += 4) {  // quads[k + c]: column c of each 128-bit part, of rows k .. k + 3
        quads[k] = _mm256_unpacklo_epi64(pairs[k], pairs[k + 2]);
        quads[k + 1] = _mm256_unpackhi_epi64(pairs[k], pairs[k + 2]);
        quads[k + 2] = _mm256_unpacklo_epi64(pairs[k + 1], pairs[k + 3]);
        quads[k + 3] = _mm256_unpackhi_epi64(pairs[k + 1], pairs[k + 3]);
    }
    for (int c = 0; c < 4; ++c) {
        rows[c] = _mm256_permute2x128_si256(quads[c], quads[c + 4], 0x20);
        rows[c + 4] = _mm256_permute2x128_si256(quads[c], quads[c + 4], 0x31);
    }
}

/// Writes (x, y, z, w) lane by lane.
inline void store_quadruples(float* to, Four<Floats> v) {
    const __m256 xy_low = _mm256_unpacklo_ps(v.x, v.y), zw_low = _mm256_unpacklo_ps(v.z, v.w);
    const __m256 xy_high = _mm256_unpackhi_ps(v.x, v.y), zw_high = _mm256_unpackhi_ps(v.z, v.w);
    const auto joined = [](__m256 xy, __m256 zw, bool second) {
        const __m256d a = _mm256_castps_pd(xy), b = _mm256_castps_pd(zw);
        return _mm256_castpd_ps(second ? _mm256_unpackhi_pd(a, b) : _mm256_unpacklo_pd(a, b));
    };
    // Quadruple k holds the lanes k and k + 4.
    const __m256 quadruple[4] = {joined(xy_low, zw_low, false), joined(xy_low, zw_low, true),
                                 joined(xy_high, zw_high, false), joined(xy_high, zw_high, true)};
    for (int k = 0; k < 4; ++k) {
        _mm_store_ps(to + 4 * k, _mm256_castps256_ps128(quadruple[k]));
        _mm_store_ps(to + 4 * (k + 4), _mm256_extractf128_ps(quadruple[k], 1));
    }
}

#else

/// a b + c; this set has no instruction with one rounding.
inline Floats fused(Floats a, Floats b, Floats c) {
    return a * b + c;
}
inline Floats square_root(Floats v) {
    for (int lane = 0; lane < width; ++lane) v[lane] = __builtin_sqrtf(v[lane]);
    return v;
}
/// v where it is positive, else 0; also for NaN.
inline Floats positive_part(Floats v) {
#if defined(__SSE2__)
    return _mm_max_ps(v, Floats{});  // g++ makes two instructions of the other form
#else
    return v > 0 ? v : Floats{};
#endif
}
/// v^2 where v is positive, else 0.
inline Floats positive_square(Floats v) {
    return v > 0 ? v * v : Floats{};
}
/// counter + 1 where v is positive.
inline Floats count_positive(Floats counter, Floats v) {
    return counter + (v > 0 ? all_lanes(1) : Floats{});
}

/// 1 in the lanes whose bit is set, else 0.
inline Floats ones(unsigned bits) {
    Floats v{};
    for (int lane = 0; lane < width; ++lane) v[lane] = static_cast<float>(bits >> lane & 1u);
    return v;
}

/// from[index[k]] in lane k.
inline Floats gather_one(const float* from, const std::int32_t* index) {
    return Floats{from[index[0]], from[index[1]], from[index[2]], from[index[3]]};  // lane by lane g++ would shuffle one by one
}
/// Entry k of vector m becomes entry m of vector k.
template <class Vector>
inline void transpose(Vector (&rows)[width]) {
    const Vector low_01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
    const Vector low_23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
    const Vector high_01 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
    const Vector high_23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
    rows[0] = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
    rows[1] = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
    rows[2] = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
    rows[3] = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
}
/// (x, y, z, w) of the particles index[0 .. width) out of an array of such quadruples: one load per particle and a
/// transposition.
inline Four<Floats> gather(const float* packed, const std::int32_t* index) {
    Floats v[width];
    for (int lane = 0; lane < width; ++lane) v[lane] = load(packed + 4 * static_cast<std::int64_t>(index[lane]));
    transpose(v);
    return {v[0], v[1], v[2], v[3]};
}
/// Writes (x, y, z, w) lane by lane.
inline void store_quadruples(float* to, Four<Floats> v) {
    Floats quadruples[width] = {v.x, v.y, v.z, v.w};
    transpose(quadruples);
    for (int lane = 0; lane < width; ++lane) store(to + 4 * lane, quadruples[lane]);
}

using Ints = std::int32_t __attribute__((vector_size(4 * width)));
using IntsInMemory [[gnu::may_alias]] = Ints;

inline void store(std::int32_t* to, Ints value) {
    *reinterpret_cast<IntsInMemory*>(to) = value;
}
/// Bit per lane: the first `count` lanes, or all, count >= 0.
inline unsigned first_lanes(int count) {
    return count < width ? (1u << count) - 1 : (1u << width) - 1;
}
/// Bit per lane: 0 < v < limit.
inline unsigned positive_and_below(Floats v, Floats limit) {
    const Ints chosen = (v < limit) & (v > 0);
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(chosen)));
#else
    unsigned bits = 0;
    for (int lane = 0; lane < width; ++lane) bits |= static_cast<unsigned>(chosen[lane]) & 1u << lane;
    return bits;
#endif
}
/// Writes first + k for each chosen lane k, one behind the other, and anything into the rest of `width` entries. Returns
/// their number.
inline int store_chosen(std::int32_t* to, int first, unsigned chosen) {
    Ints lanes;
    __builtin_memcpy(&lanes, lane_lists.lane[chosen], sizeof lanes);
    lanes += first;
    __builtin_memcpy(to, &lanes, sizeof lanes);
    return lane_lists.count[chosen];
}
/// from[0 .. count) and the filler behind; reads nothing there.
inline Ints load_first(const std::int32_t* from, int count, std::int32_t filler) {
    Ints values;
    if (count >= width) {
        __builtin_memcpy(&values, from, sizeof values);
        return values;
    }
    for (int lane = 0; lane < width; ++lane) values[lane] = lane < count ? from[lane] : filler;
    return values;
}

#endif

// Doubles by what the compiler makes of vectors.

inline Doubles fused(Doubles a, Doubles b, Doubles c) {
#if defined(__AVX2__)
    return _mm256_fmadd_pd(a, b, c);
#else
    return a * b + c;
#endif
}
inline Doubles square_root(Doubles v) {
#if defined(__AVX2__)
    return _mm256_sqrt_pd(v);
#else
    for (int lane = 0; lane < double_width; ++lane) v[lane] = __builtin_sqrt(v[lane]);
    return v;
#endif
}
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

/// As for floats.
inline Four<Doubles> gather(const double* packed, const std::int32_t* index) {
    const auto part = [&](int lane, int at) { return load(packed + 4 * static_cast<std::int64_t>(index[lane]) + at); };
#if defined(__AVX2__)
    const Doubles a = part(0, 0), b = part(1, 0), c = part(2, 0), d = part(3, 0);
    const Doubles xz_ab = _mm256_unpacklo_pd(a, b), yw_ab = _mm256_unpackhi_pd(a, b);
    const Doubles xz_cd = _mm256_unpacklo_pd(c, d), yw_cd = _mm256_unpackhi_pd(c, d);
    return {_mm256_permute2f128_pd(xz_ab, xz_cd, 0x20), _mm256_permute2f128_pd(yw_ab, yw_cd, 0x20),
            _mm256_permute2f128_pd(xz_ab, xz_cd, 0x31), _mm256_permute2f128_pd(yw_ab, yw_cd, 0x31)};
#else
    const Doubles a = part(0, 0), b = part(1, 0), c = part(0, 2), d = part(1, 2);
    return {__builtin_shufflevector(a, b, 0, 2), __builtin_shufflevector(a, b, 1, 3), __builtin_shufflevector(c, d, 0, 2),
            __builtin_shufflevector(c, d, 1, 3)};
#endif
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
