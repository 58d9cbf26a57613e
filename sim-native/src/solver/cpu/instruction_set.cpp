#include "natator/instruction_set.h"

#include <array>
#include <cstdlib>
#include <string>

#include "fluid_kernels.h"
#include "natator/error.h"

namespace natator {
namespace {

bool machine_has(InstructionSet set) {
#if defined(NATATOR_X86_KERNELS)
    switch (set) {
        case InstructionSet::portable:
            return true;
        case InstructionSet::avx2:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
        case InstructionSet::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("bmi2");
    }
    return false;
#else
    return set == InstructionSet::portable;
#endif
}

constexpr std::array best_first{InstructionSet::avx512, InstructionSet::avx2, InstructionSet::portable};

InstructionSet choose() {
    const char* wanted = std::getenv("NATATOR_ISA");
    for (const InstructionSet set : best_first) {
        if (wanted ? std::string(wanted) != to_string(set) : !machine_has(set)) continue;
        if (machine_has(set)) return set;
        throw InputError(std::string("environment variable NATATOR_ISA: ") + wanted +
                         " is not available on this machine");
    }
    throw InputError(std::string("environment variable NATATOR_ISA: ") + wanted +
                     " is unknown, expected portable, avx2 or avx512");
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
    }
    return "unknown";
}

namespace cpu {

template <class Real>
const FluidKernels<Real>& fluid_kernels(InstructionSet set) {
    static const FluidKernels<Real> portable_kernels = portable::fluid_kernels<Real>();
#if defined(NATATOR_X86_KERNELS)
    static const FluidKernels<Real> avx2_kernels = avx2::fluid_kernels<Real>();
    static const FluidKernels<Real> avx512_kernels = avx512::fluid_kernels<Real>();
    if (set == InstructionSet::avx512) return avx512_kernels;
    if (set == InstructionSet::avx2) return avx2_kernels;
#endif
    (void)set;
    return portable_kernels;
}

template const FluidKernels<float>& fluid_kernels<float>(InstructionSet);
template const FluidKernels<double>& fluid_kernels<double>(InstructionSet);

}  // namespace cpu
}  // namespace natator
