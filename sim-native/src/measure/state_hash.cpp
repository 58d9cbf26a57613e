#include <bit>

#include "natator/measure.h"

namespace natator {
namespace {

/// Fowler, Noll, Vo: FNV-1a with 64 bits.
class Fnv1a {
public:
    void add(double value) { add_bytes(std::bit_cast<std::uint64_t>(value), 8); }
    void add(float value) { add_bytes(std::bit_cast<std::uint32_t>(value), 4); }
    std::uint64_t value() const { return value_; }

private:
    void add_bytes(std::uint64_t bits, int bytes) {
        for (int i = 0; i < bytes; ++i) {
            value_ ^= (bits >> (8 * i)) & 0xff;
            value_ *= 0x100000001b3;
        }
    }

    std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace

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
