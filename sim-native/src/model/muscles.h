#pragma once

#include "body.h"

namespace natator {

/// Adds the springs and muscles between neighbouring joints (thesis 2.4), general for slices of any size.
///
/// Places are counted from the body's axis. A particle of the front joint's slice and one of the rear joint's pair when
/// - they lie equally far from the axis sideways, or half a spacing apart if the two widths differ by an odd number;
///   likewise up and down with the heights;
/// - both lie on the same side, neither on the middle: left and right for actuators that bend sideways, above and below
/// the
///   slice's middle for those that bend up and down;
/// - the segment between them stays inside the cross-section of every slice in between: its rows, each a spacing high
/// and as
///   many spacings wide as it has particles; of a mesh a cube of a spacing for each particle.
///
/// The particles of the slice with fewer particles (of equal ones: the front slice) give `springs_per_particle` springs
/// each, shared evenly among their 1, 2 or 4 partners; what does not divide goes one by one to the partners nearest the
/// axis, of equally near ones to the lower y, then the lower z.
///
/// A body with Regions has `springs_per_particle` springs for each of their fibres instead.
void add_muscles(const Creature& creature, const BodyLayout& layout, Model& model);

}  // namespace natator
