// Of pack.h: what NEON has of its own for 4 floats; the rest is in portable.h.
#pragma once

namespace natator::physics::inline NATATOR_SET {

inline Floats fused(Floats a, Floats b, Floats c) {
    return vfmaq_f32(c, a, b);
}
inline Doubles fused(Doubles a, Doubles b, Doubles c) {
    return vfmaq_f64(c, a, b);
}
inline Floats square_root(Floats v) {
    return vsqrtq_f32(v);
}
inline Doubles square_root(Doubles v) {
    return vsqrtq_f64(v);
}

}  // namespace natator::physics::inline NATATOR_SET
