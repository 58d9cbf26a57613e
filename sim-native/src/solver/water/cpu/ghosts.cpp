#include "ghosts.h"

#include "model/boundaries.h"
#include "solver/cpu/aligned.h"

namespace natator::cpu {

template <class Real>
Ghosts<Real>::Ghosts(const Model& model) : boundaries_(boundaries_of<Real>(model)), composed_(boundaries_.size(), -1) {}

template <class Real>
int Ghosts<Real>::composed(int transform, int boundary) {
    const std::size_t place = transform * boundaries_.size() + boundary;
    if (composed_[place] < 0) {
        composed_[place] = static_cast<int>(matrices_.size());
        const Eigen::Matrix<Real, 3, 1> normal = eigen(boundaries_[boundary].surface.normal);
        const Matrix before = matrices_[transform];
        matrices_.push_back(
            boundaries_[boundary].shift > 0 ? before : (Matrix::Identity() - 2 * normal * normal.transpose()) * before);
        composed_.resize(composed_.size() + boundaries_.size(), -1);
    }
    return composed_[place];
}

/// One boundary after the other, each for all particles and the ghosts found so far.
template <class Real>
const std::vector<typename Ghosts<Real>::Ghost>& Ghosts<Real>::find(const std::vector<Vector>& positions, Real distance,
                                                                    ThreadTeam& team) {
    constexpr int min_part = 2048;  // fewer are done before another thread is awake
    ghosts_.clear();
    for (int boundary = 0; boundary < static_cast<int>(boundaries_.size()); ++boundary) {
        const auto add = [distance, &through = boundaries_[boundary]](std::vector<Ghost>& to, int particle,
                                                                      int boundaries, const Vector& x,
                                                                      const auto& transform) {
            const Real before = distance_to(through.surface, vec3(x));
            if (before >= 0 && before < distance)
                to.push_back({particle, transform(), boundaries,
                              x + (through.shift > 0 ? through.shift : -2 * before) * eigen(through.surface.normal)});
        };
        const std::size_t ghosts = ghosts_.size();
        const int transform = composed(0, boundary);
        found_.resize(team.max_parts());
        for (std::vector<Ghost>& found : found_) found.clear();
        team.for_parts(static_cast<int>(positions.size()), min_part, [&](int part, int begin, int end) {
            for (int i = begin; i < end; ++i) add(found_[part], i, 1, positions[i], [transform] { return transform; });
        });
        for (const std::vector<Ghost>& found : found_) ghosts_.insert(ghosts_.end(), found.begin(), found.end());
        for (std::size_t k = 0; k < ghosts; ++k) {
            const Ghost ghost = ghosts_[k];  // ghosts_ grows
            if (ghost.boundaries < physics::max_boundaries_of_ghost)
                add(ghosts_, ghost.particle, ghost.boundaries + 1, ghost.position,
                    [&] { return composed(ghost.transform, boundary); });
        }
    }
    return ghosts_;
}

/// A little further than `distance`, as both places are rounded.
template <class Real>
bool Ghosts<Real>::reaches_walls(const Vector& x, Real distance) const {
    for (const physics::Boundary<Real>& boundary : boundaries_)
        if (!(boundary.shift > 0) && distance_to(boundary.surface, vec3(x)) < Real(1.001) * distance) return true;
    return false;
}

template class Ghosts<float>;
template class Ghosts<double>;

}  // namespace natator::cpu
