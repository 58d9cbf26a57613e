#include <array>
#include <cstdio>

#include "natator/evaluate.h"

namespace natator {

const char* to_string(Scheme scheme) {
    switch (scheme) {
        case Scheme::flex:
            return "flex";
        case Scheme::conserving:
            return "conserving";
        case Scheme::lattice:
            return "lattice";
    }
    return "unknown";
}

const char* to_string(Precision precision) {
    return precision == Precision::double_precision ? "double" : "float";
}

const char* to_string(StopReason stopped) {
    switch (stopped) {
        case StopReason::completed:
            return "completed";
        case StopReason::touched_plane:
            return "touched-plane";
        case StopReason::no_progress:
            return "no-progress";
        case StopReason::reached:
            return "reached";
        case StopReason::unstable:
            break;
    }
    return "unstable";
}

std::string hash_text(std::uint64_t hash) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
    return text.data();
}

}  // namespace natator
