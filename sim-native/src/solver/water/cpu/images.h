#pragma once

#include <Eigen/Core>
#include <vector>

#include "natator/model.h"
#include "physics/border.h"
#include "solver/cpu/thread_team.h"

namespace natator::cpu {

/// What the water finds beyond its borders: behind walls, which let it slip, the mirror image of the water before them, and
/// behind an end of a periodic axis the water at the other end. Images of images fill edges, and those of these corners,
/// where three borders meet; there are no further ones.
template <class Real>
class Images {
public:
    using Vector = Eigen::Matrix<Real, 3, 1>;
    using Matrix = Eigen::Matrix<Real, 3, 3>;

    explicit Images(const Model& model);

    struct Image {
        int particle;  ///< whose it is
        int turn;      ///< index for matrix()
        int borders;   ///< that it went through
        Vector position;
    };
    /// Images of all particles within `distance` before a border.
    const std::vector<Image>& of(const std::vector<Vector>& positions, Real distance, ThreadTeam& team);

    /// Could something at x be within `distance` of an image behind a wall?
    bool reaches_walls(const Vector& x, Real distance) const;

    /// What it does to velocities to be an image; L becomes H L H^T.
    const Matrix& matrix(int turn) const { return matrices_[turn]; }

private:
    struct Border {
        Vector normal;
        Real offset, shift;  ///< see physics::Border
    };
    int turned(int turn, int border);

    std::vector<Border> borders_;
    std::vector<Matrix> matrices_{Matrix::Identity()};
    std::vector<int> next_;  ///< of turn and border, at turn * borders + border: the turn of both, -1 before it is there
    std::vector<Image> images_;
    std::vector<std::vector<Image>> found_;  ///< of the particles themselves, by part of them
};

}  // namespace natator::cpu
