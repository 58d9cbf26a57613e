#pragma once

#include "natator/evaluate.h"

namespace natator::bench {

/// Calls run with a number of the type that this precision computes with.
template <class Run>
auto in_precision(Precision precision, const Run& run) {
    return precision == Precision::double_precision ? run(double{}) : run(float{});
}

}  // namespace natator::bench
