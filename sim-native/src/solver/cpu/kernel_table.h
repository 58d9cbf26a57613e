// Kernels are compiled once per instruction set, each set in a namespace of its own.
#pragma once

#include "natator/instruction_set.h"

/// Declares make<Real>() of each set, and make<Real>(set), which gives that of a set; sets that this build lacks give
/// the portable one.
#define NATATOR_DECLARE_KERNELS(Kernels, make) \
    namespace portable {                       \
    template <class Real>                      \
    Kernels<Real> make();                      \
    }                                          \
    namespace avx2 {                           \
    template <class Real>                      \
    Kernels<Real> make();                      \
    }                                          \
    namespace avx512 {                         \
    template <class Real>                      \
    Kernels<Real> make();                      \
    }                                          \
    namespace neon {                           \
    template <class Real>                      \
    Kernels<Real> make();                      \
    }                                          \
    template <class Real>                      \
    const Kernels<Real>& make(InstructionSet set);
