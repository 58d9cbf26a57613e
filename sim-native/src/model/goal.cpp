#include "natator/scene.h"

namespace natator {

const char* to_string(Goal::Measure measure) {
    using Measure = Goal::Measure;
    switch (measure) {
        case Measure::distance:
            return "distance";
        case Measure::forward:
            return "forward";
        case Measure::turn:
            return "turn";
        case Measure::depth:
            return "depth";
        case Measure::reach:
            return "reach";
        case Measure::hold:
            return "hold";
        case Measure::economy:
            return "economy";
    }
    return "";
}

}  // namespace natator
