#pragma once

namespace natator {

/// Vector instruction set the hot kernels are run with. The same set gives the same bits on any machine.
enum class InstructionSet { portable, avx2, avx512, neon };

/// The best set this machine has, unless the environment variable NATATOR_ISA, set and not empty, names another one
/// (portable, avx2, avx512, neon). Throws InputError when it names none or one that this machine lacks.
InstructionSet instruction_set();

/// Whether this machine and this build have it.
bool available(InstructionSet set);

/// Its name: "portable", "avx2", "avx512".
const char* to_string(InstructionSet set);

}  // namespace natator
