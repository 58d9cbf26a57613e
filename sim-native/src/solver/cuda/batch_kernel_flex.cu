#include "advance.cuh"

namespace natator::cuda {

template const void* batch_kernel<float, Scheme::flex>(bool);
template const void* batch_kernel<double, Scheme::flex>(bool);

}  // namespace natator::cuda
