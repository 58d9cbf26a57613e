#include "base/fnv1a.h"
#include "natator/measure.h"

namespace natator {

template <class Real>
std::uint64_t state_hash(const State<Real>& state) {
    Fnv1a hash;
    for (const auto* vectors : {&state.position, &state.velocity}) {
        for (const auto& vector : *vectors) {
            for (const Real component : vector) hash.add(component);
        }
    }
    return hash.value();
}

template std::uint64_t state_hash(const State<float>&);
template std::uint64_t state_hash(const State<double>&);

}  // namespace natator
