#include "natator/gait.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/check_values.h"
#include "base/text.h"
#include "check_gait.h"
#include "natator/error.h"

namespace natator {
namespace {

constexpr double max_drive = 2;  // at which the outermost muscle of a side has no length left
constexpr double max_scale = 4;

constexpr auto none = "there is none";

}  // namespace

Steering no_steering(int actuators) {
    const auto count = static_cast<std::size_t>(actuators);
    return {std::vector<double>(count, 1), std::vector<double>(count, 0)};
}

Steering steering_of_drive(const std::vector<double>& values) {
    return {std::vector<double>(values.size(), 0), values};
}

bool leaves_gait(const Steering& steering) {
    return std::all_of(steering.scale.begin(), steering.scale.end(), [](double scale) { return scale == 1; }) &&
           std::all_of(steering.offset.begin(), steering.offset.end(), [](double offset) { return offset == 0; });
}

void check_drive(const std::vector<double>& values, int actuators, const char* name) {
    check_values(name, values, actuators, -max_drive, max_drive, none);
}

void check_steering(const Steering& steering, const Gait& gait, int actuators) {
    check_lengths(gait, actuators);
    check_values("scale", steering.scale, actuators, 0, max_scale, none);
    check_values("offset", steering.offset, actuators, -max_drive, max_drive, none);
    for (std::size_t i = 0; i < steering.scale.size(); ++i) {
        const double offset = gait.offset.empty() ? 0 : gait.offset[i], beat = gait.amplitude[i] + std::abs(offset);
        const double most = steering.scale[i] * beat + std::abs(steering.offset[i]);
        if (most <= max_drive) continue;
        std::ostringstream text;
        text << "scale[" << i << "] = " << number_text(steering.scale[i]) << " and offset[" << i
             << "] = " << number_text(steering.offset[i]) << ": scale times the gait's own largest drive, "
             << computed_text(beat) << ", plus |offset| must be at most " << max_drive << ", is " << computed_text(most)
             << " (a muscle has no length below 0)";
        throw InputError(text.str());
    }
}

std::vector<double> steer(const Steering& from, const Steering& to, double part, std::vector<double> driven) {
    for (const Steering* one : {&from, &to}) {
        check_length("scale", one->scale.size(), static_cast<int>(driven.size()));
        check_length("offset", one->offset.size(), static_cast<int>(driven.size()));
    }
    for (std::size_t i = 0; i < driven.size(); ++i) {
        driven[i] =
            std::lerp(from.scale[i], to.scale[i], part) * driven[i] + std::lerp(from.offset[i], to.offset[i], part);
    }
    return driven;
}

}  // namespace natator
