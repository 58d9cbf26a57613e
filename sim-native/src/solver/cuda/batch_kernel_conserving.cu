#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, Scheme::conserving>(bool);
template const void* batch_kernel<double, Scheme::conserving>(bool);

}  // namespace natator::cuda
