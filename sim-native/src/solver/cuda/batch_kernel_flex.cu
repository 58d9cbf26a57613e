#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, Scheme::flex, false>(bool);
template const void* batch_kernel<double, Scheme::flex, false>(bool);

}  // namespace natator::cuda
