#pragma once

#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// Where a body has gone and how it lies, against the model at rest. Its rotation is that of all its particles that fits
/// best (Umeyama 1991), so that bends to both sides do not count.
struct Course {
    double forward = 0;  ///< way along its own heading, length: along the bisector of headings at start and end, which is
                         ///< the chord of an arc
    double yaw = 0;      ///< angle of the heading in the horizontal plane, from +x towards +z, rad
    double roll = 0;     ///< angle of its back about its heading, from the vertical towards its right, rad
};

/// The course of one of the model's bodies that has come to `end`, `distance` along x.
template <class Real>
Course course_of(const Model& model, const Body& body, const State<Real>& end, double distance);

}  // namespace natator
