#pragma once

#include <string>

namespace natator::bench {

/// Processor, number of processors and compiler in words, without commas.
std::string machine_text();

/// Sets the mark that peak_memory_mb() counts from, where the system can (Linux).
void forget_peak_memory();

/// The most memory that the process held since the mark, or since its start, in units of 10^6 bytes.
double peak_memory_mb();

}  // namespace natator::bench
