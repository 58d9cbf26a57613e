#pragma once

#include "natator/model.h"

namespace natator {

/// Whether a State of one model is one of the other too: the same particles at the same places of the start, the same
/// springs, clusters, muscles and body. Parameters, scheme, time step, planes, masses and stiffnesses may differ.
bool same_layout(const Model& a, const Model& b);

}  // namespace natator
