#include "natator/instruction_set.h"

#include <array>
#include <cstdlib>
#include <string>

#include "conserving/density_kernels.h"
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

namespace {

/// One table of kernels per instruction set that this build has.
template <class Kernels>
struct KernelTables {
    Kernels portable;
#if defined(NATATOR_X86_KERNELS)
    Kernels avx2, avx512;
#endif

    const Kernels& of([[maybe_unused]] InstructionSet set) const {
#if defined(NATATOR_X86_KERNELS)
        if (set == InstructionSet::avx512) return avx512;
        if (set == InstructionSet::avx2) return avx2;
#endif
        return portable;
    }
};

#if defined(NATATOR_X86_KERNELS)
#define NATATOR_TABLES(make) \
    { portable::make(), avx2::make(), avx512::make() }
#else
#define NATATOR_TABLES(make) \
    { portable::make() }
#endif

}  // namespace

template <class Real>
const FluidKernels<Real>& fluid_kernels(InstructionSet set) {
    static const KernelTables<FluidKernels<Real>> tables NATATOR_TABLES(fluid_kernels<Real>);
    return tables.of(set);
}

template <class Real>
const DensityKernels<Real>& density_kernels(InstructionSet set) {
    static const KernelTables<DensityKernels<Real>> tables NATATOR_TABLES(density_kernels<Real>);
    return tables.of(set);
}

template const FluidKernels<float>& fluid_kernels<float>(InstructionSet);
template const FluidKernels<double>& fluid_kernels<double>(InstructionSet);
template const DensityKernels<float>& density_kernels<float>(InstructionSet);
template const DensityKernels<double>& density_kernels<double>(InstructionSet);

}  // namespace cpu
}  // namespace natator
