#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, false>(bool);
template const void* batch_kernel<double, false>(bool);

}  // namespace natator::cuda
