#include "machine.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace natator::bench {
namespace {

/// What follows the colon in the first line of a file that begins with `name`.
std::string field_of(const char* path, const std::string& name) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(name)) continue;
        const auto colon = line.find(':');
        const auto value = line.find_first_not_of(" \t", colon + 1);
        return value == std::string::npos ? "" : line.substr(value);
    }
    return "";
}

}  // namespace

std::string machine_text() {
    std::string processor = field_of("/proc/cpuinfo", "model name");
    if (processor.empty()) processor = "unknown processor";
    std::string text = processor + "; " + std::to_string(std::thread::hardware_concurrency()) + " processors; ";
#if defined(__clang__)
    text += "clang " + std::to_string(__clang_major__);
#else
    text += "gcc " + std::to_string(__GNUC__);
#endif
    std::replace(text.begin(), text.end(), ',', ' ');
    return text;
}

void forget_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
    const std::string peak = field_of("/proc/self/status", "VmHWM");
    if (!peak.empty()) return std::stod(peak) * 1024e-6;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

}  // namespace natator::bench
