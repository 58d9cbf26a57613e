#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, Scheme::flex, true>(bool);
template const void* batch_kernel<double, Scheme::flex, true>(bool);

}  // namespace natator::cuda
