// Of pack.h: AVX2, 8 floats.
#pragma once

#include "physics/pack/avx.h"
#include "physics/pack/lane_lists.h"

namespace natator::physics::inline NATATOR_SET {

inline Floats fused(Floats a, Floats b, Floats c) {
    return _mm256_fmadd_ps(a, b, c);
}
inline Floats square_root(Floats v) {
    return _mm256_sqrt_ps(v);
}
inline Floats positive_part(Floats v) {
    return _mm256_max_ps(v, _mm256_setzero_ps());
}
inline Floats positive_square(Floats v) {
    return _mm256_and_ps(_mm256_cmp_ps(v, _mm256_setzero_ps(), _CMP_GT_OQ), _mm256_mul_ps(v, v));
}
inline Floats count_positive(Floats counter, Floats v) {
    const __m256 positive = _mm256_cmp_ps(v, _mm256_setzero_ps(), _CMP_GT_OQ);
    return counter + _mm256_and_ps(positive, _mm256_set1_ps(1));
}

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

// One load per particle and a transposition, which is faster than one gather per value.
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

inline Floats gather_one(const float* from, const std::int32_t* index) {
    return _mm256_set_m128(four_values(from, index + 4), four_values(from, index));
}

inline void store(std::int32_t* to, Ints value) {
    _mm256_store_si256(reinterpret_cast<Ints*>(to), value);
}
/// first, first + 1, ...
inline Ints consecutive(int first) {
    return _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}
inline unsigned first_lanes(int count) {
    return _bzhi_u32(0xff, static_cast<unsigned>(count < width ? count : width));
}
inline unsigned positive_and_below(Floats v, Floats limit) {
    const __m256 below = _mm256_cmp_ps(v, limit, _CMP_LT_OQ);
    const __m256 positive = _mm256_cmp_ps(v, _mm256_setzero_ps(), _CMP_GT_OQ);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_and_ps(below, positive)));
}

constexpr LaneLists<std::uint8_t> lane_lists = list_lanes<std::uint8_t>();  // 2 KiB; of ints it would be 8
inline int store_chosen(std::int32_t* to, int first, unsigned chosen) {
    const __m128i lanes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(lane_lists.lane[chosen]));
    const Ints numbers = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_cvtepu8_epi32(lanes));
    _mm256_storeu_si256(reinterpret_cast<__m256i_u*>(to), numbers);
    return __builtin_popcount(chosen);
}
inline Ints load_first(const std::int32_t* from, int count, std::int32_t filler) {
    const Ints wanted = _mm256_cmpgt_epi32(_mm256_set1_epi32(count), consecutive(0));
    return _mm256_blendv_epi8(_mm256_set1_epi32(filler), _mm256_maskload_epi32(from, wanted), wanted);
}
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

}  // namespace natator::physics::inline NATATOR_SET
