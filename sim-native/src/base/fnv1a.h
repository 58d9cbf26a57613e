#pragma once

#include <cstdint>
#include <cstring>
#include <span>

namespace natator {

/// Fowler, Noll, Vo: FNV-1a with 64 bits.
class Fnv1a {
public:
    void add(double value) { add_bytes(bits_of<std::uint64_t>(value), 8); }
    void add(float value) { add_bytes(bits_of<std::uint32_t>(value), 4); }
    void add(std::span<const char> bytes) {
        for (const char byte : bytes) add_bytes(static_cast<unsigned char>(byte), 1);
    }
    std::uint64_t value() const { return value_; }

private:
    // std::bit_cast, which libc++ before 14 lacks.
    template <class Bits, class Real>
    static Bits bits_of(Real value) {
        static_assert(sizeof(Bits) == sizeof value);
        Bits bits;
        std::memcpy(&bits, &value, sizeof bits);
        return bits;
    }
    void add_bytes(std::uint64_t bits, int bytes) {
        for (int i = 0; i < bytes; ++i) {
            value_ ^= (bits >> (8 * i)) & 0xff;
            value_ *= 0x100000001b3;
        }
    }

    std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace natator
