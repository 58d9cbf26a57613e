#include "water/larva.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace natator::bench {
namespace {

// Bending of larvae that swim steadily (Müller, van Leeuwen: Swimming of larval zebrafish, 2004): the head is stiff; behind it
// the largest curvature is high and rises gently along the trunk, to 6 / length; it travels at an even speed, as a wave 1.2 times as
// long as that of the displacement, which here is as long as the body.
constexpr double stiff = 0.2, bending = 0.3, end_of_trunk = 0.9;  ///< distances from the nose, of the length
constexpr double first_curvature = 4, largest_curvature = 6;      ///< there, times the length
constexpr double wave_length = 1.2;                               ///< of the length

double largest_curvature_at(double s) {
    if (s < bending) return first_curvature * std::max(0.0, (s - stiff) / (bending - stiff));
    const double along = std::min(1.0, (s - bending) / (end_of_trunk - bending));
    return first_curvature + along * (largest_curvature - first_curvature);
}

// Half the hull's width and height, of the length: the head is round, the trunk narrows to a tail that is as high, with its fins.
constexpr double nose = 0.12, neck = 0.35;
constexpr double head_width = 0.07, trunk_width = 0.05, tail_width = 0.03, height = 0.075;

double half_width_at(double s) {
    if (s < neck) return head_width + s / neck * (trunk_width - head_width);
    return trunk_width + (s - neck) / (1 - neck) * (tail_width - trunk_width);
}

double roundness_at(double s) {
    return s < nose ? std::sqrt(1 - std::pow(1 - s / nose, 2)) : 1;
}

constexpr int parts = 400;  ///< of the midline that are summed

constexpr double slow_reynolds = 60, slow_strouhal = 2.5, fast_reynolds = 1400, fast_strouhal = 0.72;
const double fall = std::log(slow_strouhal / fast_strouhal) / std::log(fast_reynolds / slow_reynolds);

}  // namespace

Larva::Larva(double length, double frequency, double thinnest)
    : length_(length), frequency_(frequency), thinnest_(thinnest) {}

bool Larva::holds(const Eigen::Vector3d& x) const {
    const double s = -x.x() / length_;
    if (s < 0 || s > 1) return false;
    const double width = std::max(half_width_at(s) * length_, thinnest_), high = std::max(height * length_, thinnest_);
    return std::hypot(x.z() / width, x.y() / high) <= roundness_at(s);
}

std::vector<Eigen::Vector3d> Larva::bent(const std::vector<Eigen::Vector3d>& straight, double time) const {
    constexpr double turn = 2 * std::numbers::pi;
    const double beats = time * frequency_;
    const double grown = beats < 1 ? (1 - std::cos(std::numbers::pi * beats)) / 2 : 1;
    const double ds = 1.0 / parts;
    std::vector<double> angle(parts + 1), x(parts + 1), z(parts + 1);  // of the midline, by its parts' ends; of the length
    for (int k = 0; k < parts; ++k) {
        const double s = (k + 0.5) * ds;
        const double curvature = grown * largest_curvature_at(s) * std::sin(turn * (beats - s / wave_length));
        angle[k + 1] = angle[k] + ds * curvature;
        const double between = (angle[k] + angle[k + 1]) / 2;
        x[k + 1] = x[k] - ds * std::cos(between);
        z[k + 1] = z[k] + ds * std::sin(between);
    }
    std::vector<Eigen::Vector3d> places;
    for (const Eigen::Vector3d& at : straight) {
        const double s = std::clamp(-at.x() / length_, 0.0, 1.0) * parts;
        const int k = std::min(static_cast<int>(s), parts - 1);
        const auto here = [&, part = s - k](const std::vector<double>& of) { return of[k] + part * (of[k + 1] - of[k]); };
        const double turned = here(angle);
        places.emplace_back(length_ * here(x) + at.z() * std::sin(turned), at.y(),
                            length_ * here(z) + at.z() * std::cos(turned));
    }
    return places;
}

double strouhal_of_larvae(double reynolds) {
    return slow_strouhal * std::pow(reynolds / slow_reynolds, -fall);
}

double reynolds_of_larvae(double beating) {
    return slow_reynolds * std::pow(beating / (slow_reynolds * slow_strouhal), 1 / (1 - fall));
}

}  // namespace natator::bench
