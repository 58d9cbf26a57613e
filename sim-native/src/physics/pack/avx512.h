// Of pack.h: AVX-512, 16 floats.
#pragma once

#include "physics/pack/avx.h"

namespace natator::physics::inline NATATOR_SET {

inline Floats fused(Floats a, Floats b, Floats c) {
    return _mm512_fmadd_ps(a, b, c);
}
inline Floats square_root(Floats v) {
    return _mm512_sqrt_ps(v);
}
inline Floats positive_part(Floats v) {
    return _mm512_max_ps(v, _mm512_setzero_ps());
}
inline Floats positive_square(Floats v) {
    return _mm512_maskz_mul_ps(_mm512_cmp_ps_mask(v, _mm512_setzero_ps(), _CMP_GT_OQ), v, v);
}
inline Floats count_positive(Floats counter, Floats v) {
    const __mmask16 positive = _mm512_cmp_ps_mask(v, _mm512_setzero_ps(), _CMP_GT_OQ);
    return _mm512_mask_add_ps(counter, positive, counter, _mm512_set1_ps(1));
}

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

// One load per particle and a transposition, which is faster than one gather per value.
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

// Four lanes apart from the next four: lane after lane of one vector would wait for each other.
inline Floats gather_one(const float* from, const std::int32_t* index) {
    const __m256 low = _mm256_set_m128(four_values(from, index + 4), four_values(from, index));
    const __m256 high = _mm256_set_m128(four_values(from, index + 12), four_values(from, index + 8));
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}

inline void store(std::int32_t* to, Ints value) {
    _mm512_store_si512(to, value);
}
/// first, first + 1, ...
inline Ints consecutive(int first) {
    return _mm512_add_epi32(_mm512_set1_epi32(first),
                            _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}
inline unsigned first_lanes(int count) {
    return _bzhi_u32(0xffff, static_cast<unsigned>(count < width ? count : width));
}
inline unsigned positive_and_below(Floats v, Floats limit) {
    const __mmask16 below = _mm512_cmp_ps_mask(v, limit, _CMP_LT_OQ);
    return _mm512_mask_cmp_ps_mask(below, v, _mm512_setzero_ps(), _CMP_GT_OQ);
}
inline int store_chosen(std::int32_t* to, int first, unsigned chosen) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(chosen), consecutive(first)));
    return __builtin_popcount(chosen);
}
inline Ints load_first(const std::int32_t* from, int count, std::int32_t filler) {
    const auto wanted = static_cast<__mmask16>(first_lanes(count < 0 ? 0 : count));
    return _mm512_mask_loadu_epi32(_mm512_set1_epi32(filler), wanted, from);
}
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

}  // namespace natator::physics::inline NATATOR_SET
