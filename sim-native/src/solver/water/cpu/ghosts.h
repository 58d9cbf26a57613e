#pragma once

#include <Eigen/Core>
#include <vector>

#include "natator/model.h"
#include "physics/boundary.h"
#include "solver/cpu/thread_team.h"

namespace natator::cpu {

/// Ghosts of the water: copies of particles behind its boundaries. Behind walls, along which water slips, they are
/// mirrored; behind an end of a periodic axis they are what is at the other end. Ghosts of ghosts fill edges, and those
/// of these corners, where three boundaries meet; there are no further ones.
template <class Real>
class Ghosts {
public:
    using Vector = Eigen::Matrix<Real, 3, 1>;
    using Matrix = Eigen::Matrix<Real, 3, 3>;

    explicit Ghosts(const Model& model);

    struct Ghost {
        int particle;    ///< whose it is
        int transform;   ///< index for matrix()
        int boundaries;  ///< how many it went through
        Vector position;
    };
    /// Ghosts of all particles that are within `distance` of a boundary.
    const std::vector<Ghost>& find(const std::vector<Vector>& positions, Real distance, ThreadTeam& team);

    /// Whether something at x could be within `distance` of a ghost behind a wall.
    bool reaches_walls(const Vector& x, Real distance) const;

    /// H: turns vectors of a particle into those of its ghost, and L into H L H^T.
    const Matrix& matrix(int transform) const { return matrices_[transform]; }

private:
    int composed(int transform, int boundary);

    std::vector<physics::Boundary<Real>> boundaries_;
    std::vector<Matrix> matrices_{Matrix::Identity()};
    /// by transform * boundaries + boundary: the transform through both, -1 until it is needed
    std::vector<int> composed_;
    std::vector<Ghost> ghosts_;
    std::vector<std::vector<Ghost>> found_;  ///< through one boundary, by part of the particles
};

}  // namespace natator::cpu
