#include "rest_packing.h"

#include <cmath>

namespace natator::cpu {

double rest_packing_sum(double ratio, const std::function<double(double)>& kernel) {
    const int n = static_cast<int>(std::ceil(1 / ratio)) + 1;
    double sum = 0;
    for (int z = -n; z <= n; ++z)
        for (int y = -n; y <= n; ++y)
            for (int x = -n; x <= n; ++x) {
                const double shift = (y + z) % 2 != 0 ? 0.5 : 0.0;
                const double q = ratio * std::hypot(x + shift, y * std::sqrt(0.75), z * std::sqrt(0.75));
                if (q > 0 && q < 1) sum += kernel(q);
            }
    return sum;
}

}  // namespace natator::cpu
