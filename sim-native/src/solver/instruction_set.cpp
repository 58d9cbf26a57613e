#include "natator/instruction_set.h"

#include <array>
#include <cstdlib>
#include <string>

#include "base/text.h"
#include "cpu/fluid_kernels.h"
#include "cpu/motion_kernels.h"
#include "cpu/neighbour_kernels.h"
#include "cpu/plane_kernels.h"
#include "natator/error.h"
#include "solver/lattice/kernels.h"
#include "water/cpu/water_kernels.h"

namespace natator {

bool available(InstructionSet set) {
    if (set == InstructionSet::portable) return true;
#if defined(NATATOR_X86_KERNELS)
    switch (set) {
        case InstructionSet::avx2:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
        case InstructionSet::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("bmi2");
        default:
            return false;
    }
#elif defined(NATATOR_ARM_KERNELS)
    return set == InstructionSet::neon;  // which all have
#else
    return false;
#endif
}

namespace {

constexpr std::array best_first{InstructionSet::avx512, InstructionSet::avx2, InstructionSet::neon,
                                InstructionSet::portable};

[[noreturn]] void refuse(const char* wanted, const std::string& must_be) {
    throw InputError("environment: NATATOR_ISA = " + quoted(wanted) + ": must be " + must_be);
}

InstructionSet choose() {
    const char* wanted = std::getenv("NATATOR_ISA");
    if (wanted && *wanted == '\0') wanted = nullptr;
    for (const InstructionSet set : best_first) {
        if (wanted ? std::string(wanted) != to_string(set) : !available(set)) continue;
        if (available(set)) return set;
        refuse(wanted, "one that this machine has");
    }
    refuse(wanted, "portable, avx2, avx512 or neon");
}

}  // namespace

InstructionSet instruction_set() {
    static const InstructionSet chosen = choose();
    return chosen;
}

const char* to_string(InstructionSet set) {
    switch (set) {
        case InstructionSet::portable:
            return "portable";
        case InstructionSet::avx2:
            return "avx2";
        case InstructionSet::avx512:
            return "avx512";
        case InstructionSet::neon:
            return "neon";
    }
    return "unknown";
}

namespace cpu {

// A function that gives the kernels of this name for an instruction set. It calls the maker of that set alone: a maker
// is compiled for its set as its kernels are, and a processor that lacks the set can't run it.
#define NATATOR_MADE_BY(set, Kernels, make)                    \
    {                                                          \
        static const Kernels<Real> chosen = set::make<Real>(); \
        return chosen;                                         \
    }
#if defined(NATATOR_X86_KERNELS)
#define NATATOR_MADE_HERE(set, Kernels, make)                                 \
    if (set == InstructionSet::avx512) NATATOR_MADE_BY(avx512, Kernels, make) \
    if (set == InstructionSet::avx2) NATATOR_MADE_BY(avx2, Kernels, make)
#elif defined(NATATOR_ARM_KERNELS)
#define NATATOR_MADE_HERE(set, Kernels, make) \
    if (set == InstructionSet::neon) NATATOR_MADE_BY(neon, Kernels, make)
#else
#define NATATOR_MADE_HERE(set, Kernels, make)
#endif
#define NATATOR_CHOICE(Kernels, make)                                \
    template <class Real>                                            \
    const Kernels<Real>& make([[maybe_unused]] InstructionSet set) { \
        NATATOR_MADE_HERE(set, Kernels, make)                        \
        NATATOR_MADE_BY(portable, Kernels, make)                     \
    }                                                                \
    template const Kernels<float>& make<float>(InstructionSet);      \
    template const Kernels<double>& make<double>(InstructionSet);

NATATOR_CHOICE(FluidKernels, fluid_kernels)
NATATOR_CHOICE(FluidKernels, scalar_fluid_kernels)
NATATOR_CHOICE(MotionKernels, motion_kernels)
NATATOR_CHOICE(PlaneKernels, plane_kernels)
NATATOR_CHOICE(PlaneKernels, scalar_plane_kernels)
NATATOR_CHOICE(NeighbourKernels, neighbour_kernels)
NATATOR_CHOICE(NeighbourKernels, scalar_neighbour_kernels)
NATATOR_CHOICE(WaterKernels, water_kernels)
NATATOR_CHOICE(WaterKernels, scalar_water_kernels)

}  // namespace cpu

namespace lattice {

NATATOR_CHOICE(Kernels, kernels)

}  // namespace lattice
}  // namespace natator
