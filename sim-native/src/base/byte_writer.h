#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace natator {

/// Appends values to a string as the bytes that they are in memory; vectors with their length in front.
class ByteWriter {
public:
    template <class T>
        requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void add(T value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class Real, int Rows>
    void add(const Eigen::Matrix<Real, Rows, 1>& vector) {
        for (const Real component : vector) add(component);
    }
    template <class Real>
    void add(const Eigen::Quaternion<Real>& rotation) {
        add(rotation.coeffs());
    }
    void add(const std::string& text) {
        add(text.size());
        bytes_ += text;
    }
    template <class T>
    void add(const std::vector<T>& values) {
        add(values.size());
        for (const T& value : values) add(value);
    }

    /// Numbers as they are, without their count.
    template <class T>
    void add_all(std::span<const T> values) {
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    }

    const std::string& bytes() const { return bytes_; }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

}  // namespace natator
