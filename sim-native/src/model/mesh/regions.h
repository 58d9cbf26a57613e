#pragma once

#include <memory>

#include "natator/scene.h"

namespace natator {

/// Where the regions of a body have their middles, and how their muscles move it. Lengths are in spacings from the
/// centre of the last slice, x forward, y up, z right.
struct ControlPoints {
    int count = 0;                        ///< of points that are sampled; 0: there are `places`
    std::vector<Eigen::Vector3d> places;  ///< one off the middle (|z| > 1/2) stands for its mirror image, too
    std::vector<Bend> bends;              ///< one actuator each for every pair of neighbouring regions
};

/// Fewest and most control points.
inline constexpr int min_control_points = 2, max_control_points = 64;

/// Clusters and muscles of a mesh's slices, which are symmetric, around control points. Nothing but whole numbers
/// decides what belongs to what, so that the same body has the same regions everywhere.
///
/// Distances go through the body: from particle to neighbouring particle by chamfer lengths 3, 4, 5 for a spacing and
/// the diagonals of a square and a cube (Borgefors: Distance transformations in arbitrary dimensions, 1984). Points are
/// sampled as the farthest from those before (Gonzalez 1985), the first at the middle of the head. Each is taken with
/// its mirror image: as one point where the two are nearer to each other than to the points before, else as two, so
/// that there may be one less than asked for. Points are in order from the head, left before right.
///
/// A region has the particles that are at most a spacing farther from its point than from the nearest one: neighbouring
/// regions share about a layer of particles, their border, as clusters share a slice in thesis 2.2.
///
/// Muscles of two regions, at least four, run through the particles of their border, parallel to the line between the
/// regions' centres, as far to either side as the body, the region and half that line go. `lateral` is how far one is
/// from the border's middle, over the farthest: upwards to bend up and down, across that and the line to bend sideways
/// (to the right between a point and one behind it); or 1 to contract. A pair of regions and its mirror image share an
/// actuator. To contract, so do all pairs whose borders' middles are within a spacing of the one before along the body,
/// as around a bell. Actuators are in order of their borders from the head.
///
/// `vertices` are those of the skin: each follows the region whose point is nearest to the particle nearest to it, and
/// the next nearest, by the inverse of these distances. Refuses by an InputError that says what a body in several
/// pieces, more points than fit 2 spacings apart, a place that is more than 2 spacings from all particles or nearer
/// than that to another one's, one between two parts of the body, and regions without muscles.
std::shared_ptr<const Regions> make_regions(const std::vector<Slice>& slices, const ControlPoints& points,
                                            const std::vector<Eigen::Vector3d>& vertices);

}  // namespace natator
