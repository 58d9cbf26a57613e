#pragma once

#include "natator/scene.h"

/// Cross-sections on a lattice of one spacing. All lengths are in spacings.
namespace natator {

/// Fewest spacings that count as two particles across.
inline constexpr double min_across = 1.5;

/// The particles inside an ellipse of this height and width, at least `min_across` each, taking a particle for the
/// centre of a square of one spacing. As many columns as is nearest to the width; of an odd or even number of rows what
/// has the area nearest to the ellipse's. Two particles or more each way; the same to the left and right, above and
/// below.
Slice ellipse_slice(double height, double width);

/// A rectangle, as a fin has it: as many particles each way as is nearest, one at least.
Slice plate_slice(double height, double thickness);

}  // namespace natator
