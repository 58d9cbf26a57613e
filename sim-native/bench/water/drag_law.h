#pragma once

namespace natator::bench {

/// Drag coefficient of a sphere: Schiller and Naumann (1933).
double drag_of_sphere(double reynolds);

/// What a change of a sphere's speed `age` s ago still adds to its drag, times 3 pi mu d for the change: Mei and Adrian
/// (1992, J. Fluid Mech. 237, 323-341), with the present speed; Basset's 1 / sqrt(4 pi nu age / d^2) for a slow one.
double history_of_drag(double age, double speed, double diameter, double viscosity);

/// By how much more than at its own speed a body that is towed along a box is passed by the water, in parts of the
/// speed: of the room that it takes, and of the water that its wake drags along, both of which the rest must make good
/// for between the walls. Estimates for free-slip walls, as of a wind tunnel (Barlow, Rae, Pope: Low-Speed Wind Tunnel
/// Testing, 1999, ch. 10: Thom, Glauert, Maskell).
double blockage_of_sphere(double drag_coefficient, double diameter, double cross_section);
/// Between planes `height` apart, to which it is parallel.
double blockage_of_cylinder(double drag_coefficient, double diameter, double height);

}  // namespace natator::bench
