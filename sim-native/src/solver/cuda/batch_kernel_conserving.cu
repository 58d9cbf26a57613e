#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, Scheme::conserving, false>(bool);
template const void* batch_kernel<double, Scheme::conserving, false>(bool);

}  // namespace natator::cuda
