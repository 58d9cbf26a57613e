#include "../native/laws.h"

#include "natator/batch.h"
#include "solver/gpu_solver.h"

namespace natator::test {

struct OnAGpu {
    template <class Real>
    using Solver = GpuSolver<Real>;
    static const char* missing() { return cuda_devices().empty() ? "no GPU here" : nullptr; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Gpu, Laws, OnAGpu);

}  // namespace natator::test
