#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, true>(bool);
template const void* batch_kernel<double, true>(bool);

}  // namespace natator::cuda
