#include "laws.h"

namespace natator::test {

struct OnTheCpu {
    template <class Real>
    using Solver = natator::Solver<Real>;
    static const char* missing() { return nullptr; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Cpu, Laws, OnTheCpu);

}  // namespace natator::test
