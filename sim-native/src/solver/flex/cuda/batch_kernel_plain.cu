#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, false>(TeamKind);
template const void* batch_kernel<double, false>(TeamKind);

}  // namespace natator::cuda
