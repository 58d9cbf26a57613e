#pragma once

#include <algorithm>
#include <cmath>

#include "natator/solver.h"

namespace natator::cpu {

/// Sums a Residual of errors that come one after the other.
class ResidualSum {
public:
    void add(double error) {
        const double size = std::abs(error);
        max_ = std::max(max_, size);
        sum_ += size;
        ++count_;
    }
    Residual residual() const { return {max_, count_ > 0 ? sum_ / static_cast<double>(count_) : 0}; }

private:
    double max_ = 0, sum_ = 0;
    long count_ = 0;
};

}  // namespace natator::cpu
