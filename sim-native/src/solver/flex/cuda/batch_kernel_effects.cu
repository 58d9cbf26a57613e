#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, true>(TeamKind);
template const void* batch_kernel<double, true>(TeamKind);

}  // namespace natator::cuda
