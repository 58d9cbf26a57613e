#include "check_kernel_support.h"

#include "gait/check_values.h"
#include "natator/limits.h"

namespace natator {

void check_kernel_support(const SolverParameters& parameters, const std::string& place) {
    check_range(place + "kernelSupport", parameters.kernelSupport, limits::least_kernel_support, limits::most_kernel_support, false,
                " (rest distances of the fluid)");
}

}  // namespace natator
