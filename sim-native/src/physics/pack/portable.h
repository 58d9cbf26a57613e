// Of pack.h: 4 floats by what every compiler makes of vectors, and SSE2, NEON or WebAssembly where that is better.
#pragma once

#include "physics/pack/lane_lists.h"

namespace natator::physics::inline NATATOR_SET {

#if !defined(NATATOR_NEON)
inline Floats fused(Floats a, Floats b, Floats c) {
    return a * b + c;
}
inline Doubles fused(Doubles a, Doubles b, Doubles c) {
    return a * b + c;
}
inline Floats square_root(Floats v) {
#if defined(__wasm_simd128__)
    return static_cast<Floats>(wasm_f32x4_sqrt(static_cast<v128_t>(v)));  // clang 14 takes roots one by one
#else
    for (int lane = 0; lane < width; ++lane) v[lane] = __builtin_sqrtf(v[lane]);
    return v;
#endif
}
inline Doubles square_root(Doubles v) {
#if defined(__wasm_simd128__)
    return static_cast<Doubles>(wasm_f64x2_sqrt(static_cast<v128_t>(v)));
#else
    for (int lane = 0; lane < double_width; ++lane) v[lane] = __builtin_sqrt(v[lane]);
    return v;
#endif
}
#endif
inline Floats positive_part(Floats v) {
#if defined(__SSE2__)
    return _mm_max_ps(v, Floats{});  // g++ makes two instructions of the other form
#elif defined(__wasm_simd128__)
    return static_cast<Floats>(wasm_f32x4_pmax(v128_t{}, static_cast<v128_t>(v)));
#else
    return v > 0 ? v : Floats{};
#endif
}
inline Floats positive_square(Floats v) {
    return v > 0 ? v * v : Floats{};
}
inline Floats count_positive(Floats counter, Floats v) {
    return counter + (v > 0 ? all_lanes(1) : Floats{});
}

inline Floats ones(unsigned bits) {
    Floats v{};
    for (int lane = 0; lane < width; ++lane) v[lane] = static_cast<float>(bits >> lane & 1u);
    return v;
}

inline Floats gather_one(const float* from, const std::int32_t* index) {
    return Floats{from[index[0]], from[index[1]], from[index[2]],
                  from[index[3]]};  // lane by lane g++ would shuffle one by one
}

/// Of ints and of floats alike.
template <class Vector>
inline void transpose_lanes(Vector (&rows)[width]) {
    const Vector low_01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
    const Vector low_23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
    const Vector high_01 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
    const Vector high_23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
    rows[0] = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
    rows[1] = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
    rows[2] = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
    rows[3] = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
}
inline void transpose(Ints (&rows)[width]) {
    transpose_lanes(rows);
}
inline Four<Floats> gather(const float* packed, const std::int32_t* index) {
    Floats v[width];
    for (int lane = 0; lane < width; ++lane) v[lane] = load(packed + 4 * static_cast<std::int64_t>(index[lane]));
    transpose_lanes(v);
    return {v[0], v[1], v[2], v[3]};
}
inline void store_quadruples(float* to, Four<Floats> v) {
    Floats quadruples[width] = {v.x, v.y, v.z, v.w};
    transpose_lanes(quadruples);
    for (int lane = 0; lane < width; ++lane) store(to + 4 * lane, quadruples[lane]);
}

using IntsInMemory [[gnu::may_alias]] = Ints;

inline void store(std::int32_t* to, Ints value) {
    *reinterpret_cast<IntsInMemory*>(to) = value;
}
inline unsigned first_lanes(int count) {
    return count < width ? (1u << count) - 1 : (1u << width) - 1;
}
inline unsigned positive_and_below(Floats v, Floats limit) {
    const Ints chosen = (v < limit) & (v > 0);
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(chosen)));
#elif defined(__wasm_simd128__)
    return static_cast<unsigned>(wasm_i32x4_bitmask(static_cast<v128_t>(chosen)));
#else
    unsigned bits = 0;
    for (int lane = 0; lane < width; ++lane) bits |= static_cast<unsigned>(chosen[lane]) & 1u << lane;
    return bits;
#endif
}
constexpr LaneLists<std::int32_t> lane_lists = list_lanes<std::int32_t>();
inline int store_chosen(std::int32_t* to, int first, unsigned chosen) {
    Ints lanes;
    __builtin_memcpy(&lanes, lane_lists.lane[chosen], sizeof lanes);
    lanes += first;
    __builtin_memcpy(to, &lanes, sizeof lanes);
    return lane_lists.count[chosen];
}
inline Ints load_first(const std::int32_t* from, int count, std::int32_t filler) {
    Ints values;
    if (count >= width) {
        __builtin_memcpy(&values, from, sizeof values);
        return values;
    }
    for (int lane = 0; lane < width; ++lane) values[lane] = lane < count ? from[lane] : filler;
    return values;
}

inline Four<Doubles> gather(const double* packed, const std::int32_t* index) {
    const auto part = [&](int lane, int at) { return load(packed + 4 * static_cast<std::int64_t>(index[lane]) + at); };
    const Doubles a = part(0, 0), b = part(1, 0), c = part(0, 2), d = part(1, 2);
    return {__builtin_shufflevector(a, b, 0, 2), __builtin_shufflevector(a, b, 1, 3),
            __builtin_shufflevector(c, d, 0, 2), __builtin_shufflevector(c, d, 1, 3)};
}

}  // namespace natator::physics::inline NATATOR_SET
