#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "natator/error.h"

namespace natator {

/// Takes values from bytes in the order in which a ByteWriter has added them. Throws InputError where there are too
/// few, and for a number that is not finite.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : left_(bytes) {}

    std::string_view take(std::size_t size) {
        if (size > left_.size()) refuse();
        const std::string_view taken = left_.substr(0, size);
        left_.remove_prefix(size);
        return taken;
    }
    template <class T>
        requires std::is_arithmetic_v<T>
    void read(T& value) {
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        if constexpr (std::is_floating_point_v<T>)
            if (!std::isfinite(value)) throw InputError("state: holds a number that is not finite");
    }
    void read(bool& value) { value = take(1).front() != 0; }
    template <class Real, int Rows>
    void read(Eigen::Matrix<Real, Rows, 1>& vector) {
        for (Real& component : vector) read(component);
    }
    template <class Real>
    void read(Eigen::Quaternion<Real>& rotation) {
        read(rotation.coeffs());
    }
    void read(std::string& text) { text = take(count(1)); }
    template <class T>
    void read(std::vector<T>& values) {
        values.resize(count(sizeof(T)));
        for (T& value : values) read(value);
    }
    /// What there is, of no other length.
    std::string_view left() const { return left_; }
    void require_end() const {
        if (!left_.empty()) refuse();
    }

private:
    /// How many values follow, each of so many bytes; no more than there are.
    std::size_t count(std::size_t bytes) {
        std::size_t count = 0;
        read(count);
        if (count > left_.size() / bytes) refuse();
        return count;
    }
    [[noreturn]] static void refuse() { throw InputError("state: is not of this scene: other numbers of values"); }

    std::string_view left_;
};

}  // namespace natator
