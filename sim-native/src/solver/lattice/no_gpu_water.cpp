// What a build without CUDA answers.
#include "solver/cuda/no_cuda.h"
#include "water.h"

namespace natator {

std::unique_ptr<lattice::Water> lattice::Water::on_gpu(const Box&, int) {
    refuse_without_cuda();
}

}  // namespace natator
