// Compiled once per instruction set, like the solver's kernels and with their vectors.
#include "roof_kernels.h"

#include "physics/number.h"

namespace natator::bench::NATATOR_ISA {
namespace {

using namespace natator::physics;

float total(Floats v) {
    float sum = 0;
    for (int lane = 0; lane < width; ++lane) sum += v[lane];
    return sum;
}

float multiply_add(int rounds) {
    constexpr int chains = 12;
    Floats chain[chains];
    for (int k = 0; k < chains; ++k) chain[k] = all_lanes(static_cast<float>(k));
    const Floats factor = all_lanes(0.999f), term = all_lanes(0.001f);
    for (int round = 0; round < rounds; ++round)
        for (Floats& one : chain) one = fused(one, factor, term);
    Floats sum{};
    for (const Floats& one : chain) sum += one;
    return total(sum);
}

float sum(const float* from, int count) {
    constexpr int chains = 4;
    Floats part[chains] = {};
    for (int k = 0; k < count; k += chains * width)
        for (int c = 0; c < chains; ++c) part[c] += load(from + k + c * width);
    return total((part[0] + part[1]) + (part[2] + part[3]));
}

float sum_quadruples(const float* packed, const std::int32_t* index, int count) {
    Floats x{}, y{}, z{}, w{};
    for (int k = 0; k < count; k += width) {
        const Four<Floats> v = gather(packed, index + k);
        x += v.x;
        y += v.y;
        z += v.z;
        w += v.w;
    }
    return total((x + y) + (z + w));
}

}  // namespace

RoofKernels roof_kernels() {
    return {width, &multiply_add, &sum, &sum_quadruples};
}

}  // namespace natator::bench::NATATOR_ISA
