#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, Scheme::conserving, true>(bool);
template const void* batch_kernel<double, Scheme::conserving, true>(bool);

}  // namespace natator::cuda
