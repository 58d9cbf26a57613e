#include "profile_slices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace natator {
namespace {

constexpr double rounding = 1e-9;  ///< spacings by which a particle may lie outside

/// Whole number of places at distances 0, 1, 2, … (odd) or 1/2, 3/2, … (even) from the middle, up to `half`.
int places_within(double half, bool odd) {
    return odd ? 2 * static_cast<int>(std::floor(half + rounding)) + 1
               : 2 * static_cast<int>(std::floor(half + 0.5 + rounding));
}

/// The ellipse with an odd or even number of rows, and of particles in each.
Slice ellipse_of(double height, double width, bool odd_rows, bool odd_columns) {
    Slice slice{0, 0};
    const int rows = places_within(height / 2, odd_rows);
    for (int iy = 0; iy < rows; ++iy) {
        const double y = (2 * iy - (rows - 1)) / height;  // in half heights
        const int count = places_within(width / 2 * std::sqrt(std::max(0.0, 1 - y * y)), odd_columns);
        if (count == 0) continue;
        slice.rows.push_back(count);
        slice.width = std::max(slice.width, count);
    }
    slice.height = static_cast<int>(slice.rows.size());
    return slice;
}

}  // namespace

Slice ellipse_slice(double height, double width) {
    const double area = std::numbers::pi / 4 * height * width;
    const bool odd_height = std::lround(height) % 2 != 0;
    const bool odd_width = std::lround(width) % 2 != 0;
    Slice best;
    double least = std::numeric_limits<double>::infinity();
    for (const bool odd_columns : {odd_width, false}) {
        for (const bool odd_rows : {odd_height, !odd_height}) {
            Slice slice = ellipse_of(height, width, odd_rows, odd_columns);
            const double error = std::abs(slice.particles() - area);
            if (slice.height < 2 || slice.width < 2 || !(error < least - rounding)) continue;
            least = error;
            best = std::move(slice);
        }
        if (least < std::numeric_limits<double>::infinity()) break;  // even columns only where odd ones do not fit
    }
    return best;
}

Slice plate_slice(double height, double thickness) {
    return {std::max(1, static_cast<int>(std::lround(height))), std::max(1, static_cast<int>(std::lround(thickness)))};
}

}  // namespace natator
