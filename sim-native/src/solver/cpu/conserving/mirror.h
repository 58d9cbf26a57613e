#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "natator/model.h"

namespace natator::cpu {

/// Walls without friction, as mirrors: the water beyond a plane is the image of the water before it. Images of images
/// fill edges, and those of these corners, where three planes meet; there are no further ones.
template <class Real>
class Mirror {
public:
    using Vector = Eigen::Matrix<Real, 3, 1>;
    using Matrix = Eigen::Matrix<Real, 3, 3>;

    explicit Mirror(const Model& model);

    struct Image {
        int particle;    ///< whose it is
        int reflection;  ///< index for matrix()
        int planes;      ///< that it was reflected at
        Vector position;
    };
    /// Images of all particles within `distance` before a plane.
    const std::vector<Image>& images_of(const std::vector<Vector>& positions, Real distance);

    /// Could something at x be within `distance` of an image?
    bool reaches_images(const Vector& x, Real distance) const;

    /// What a reflection does to velocities; L becomes H L H^T.
    const Matrix& matrix(int reflection) const { return matrices_[reflection]; }

private:
    int reflected(int reflection, int plane);

    std::vector<std::pair<Vector, Real>> planes_;  ///< normal and offset
    std::vector<Matrix> matrices_{Matrix::Identity()};
    std::map<std::pair<int, int>, int> next_;  ///< (reflection, plane) -> reflection
    std::vector<Image> images_;
};

}  // namespace natator::cpu
