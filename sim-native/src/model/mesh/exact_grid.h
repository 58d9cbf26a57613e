#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <span>

/// Tests of signs without rounding. Vertices are put on a grid of 2^30 steps across the largest extent of their box;
/// what is computed of such whole numbers is exact.
namespace natator {

__extension__ using Wide = __int128;
using GridPoint = Eigen::Matrix<std::int64_t, 3, 1>;

class ExactGrid {
public:
    explicit ExactGrid(std::span<const Eigen::Vector3d> points) : low_(points.front()), high_(points.front()) {
        for (const Eigen::Vector3d& point : points) {
            low_ = low_.cwiseMin(point);
            high_ = high_.cwiseMax(point);
        }
        const double extent = (high_ - low_).maxCoeff();
        steps_ = extent > 0 ? (1 << 30) / extent : 1;
    }

    const Eigen::Vector3d& low() const { return low_; }
    const Eigen::Vector3d& high() const { return high_; }

    GridPoint at(const Eigen::Vector3d& point) const { return {at(point, 0), at(point, 1), at(point, 2)}; }
    std::int64_t at(const Eigen::Vector3d& point, int axis) const { return at(point[axis], axis); }
    std::int64_t at(double value, int axis) const { return std::llround((value - low_[axis]) * steps_); }

private:
    Eigen::Vector3d low_, high_;
    double steps_;
};

inline int sign_of(Wide value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// Twice the area of a, b, c in the plane of two axes: above 0 if they go round from the first axis to the second.
inline Wide area(const GridPoint& a, const GridPoint& b, const GridPoint& c, int first, int second) {
    return Wide{b[first] - a[first]} * (c[second] - a[second]) - Wide{b[second] - a[second]} * (c[first] - a[first]);
}

/// On which side of the plane of a, b, c a point d is: 1 where they go round clockwise seen from it, 0 on it.
inline int side(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
    const GridPoint u = b - a, v = c - a, w = d - a;
    const Wide x = Wide{u.y()} * v.z() - Wide{u.z()} * v.y();
    const Wide y = Wide{u.z()} * v.x() - Wide{u.x()} * v.z();
    const Wide z = Wide{u.x()} * v.y() - Wide{u.y()} * v.x();
    return -sign_of(x * w.x() + y * w.y() + z * w.z());
}

}  // namespace natator
