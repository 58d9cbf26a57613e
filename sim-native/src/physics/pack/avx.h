// Of pack.h: what is the same in AVX2 and AVX-512.
#pragma once

namespace natator::physics::inline NATATOR_SET {

/// from[index[k]] in lane k.
inline __m128 four_values(const float* from, const std::int32_t* index) {
    return _mm_setr_ps(from[index[0]], from[index[1]], from[index[2]], from[index[3]]);
}

inline Doubles fused(Doubles a, Doubles b, Doubles c) {
    return _mm256_fmadd_pd(a, b, c);
}
inline Doubles square_root(Doubles v) {
    return _mm256_sqrt_pd(v);
}
inline Four<Doubles> gather(const double* packed, const std::int32_t* index) {
    const auto particle = [&](int lane) { return load(packed + 4 * static_cast<std::int64_t>(index[lane])); };
    const Doubles a = particle(0), b = particle(1), c = particle(2), d = particle(3);
    const Doubles xz_ab = _mm256_unpacklo_pd(a, b), yw_ab = _mm256_unpackhi_pd(a, b);
    const Doubles xz_cd = _mm256_unpacklo_pd(c, d), yw_cd = _mm256_unpackhi_pd(c, d);
    return {_mm256_permute2f128_pd(xz_ab, xz_cd, 0x20), _mm256_permute2f128_pd(yw_ab, yw_cd, 0x20),
            _mm256_permute2f128_pd(xz_ab, xz_cd, 0x31), _mm256_permute2f128_pd(yw_ab, yw_cd, 0x31)};
}

}  // namespace natator::physics::inline NATATOR_SET
