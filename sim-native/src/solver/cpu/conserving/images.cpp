#include "images.h"

#include "../aligned.h"
#include "model/borders.h"

namespace natator::cpu {

template <class Real>
Images<Real>::Images(const Model& model) {
    for (const physics::Border<Real>& border : borders_of<Real>(model))
        borders_.push_back({eigen(border.surface.normal), border.surface.offset, border.shift});
    next_.assign(borders_.size(), -1);
}

template <class Real>
int Images<Real>::turned(int turn, int border) {
    const std::size_t place = turn * borders_.size() + border;
    if (next_[place] < 0) {
        next_[place] = static_cast<int>(matrices_.size());
        const auto& [normal, offset, shift] = borders_[border];
        const Matrix before = matrices_[turn];
        matrices_.push_back(shift > 0 ? before : (Matrix::Identity() - 2 * normal * normal.transpose()) * before);
        next_.resize(next_.size() + borders_.size(), -1);
    }
    return next_[place];
}

/// One border after the other, each of what is there by then.
template <class Real>
const std::vector<typename Images<Real>::Image>& Images<Real>::of(const std::vector<Vector>& positions, Real distance) {
    images_.clear();
    for (int border = 0; border < static_cast<int>(borders_.size()); ++border) {
        const auto& [normal, offset, shift] = borders_[border];
        const auto add = [&, n = normal, d = offset, s = shift](int particle, int turn, int borders, const Vector& x) {
            const Real before = n.dot(x) + d;
            if (before >= 0 && before < distance)
                images_.push_back({particle, turned(turn, border), borders, x + (s > 0 ? s : -2 * before) * n});
        };
        const std::size_t images = images_.size();
        for (std::size_t i = 0; i < positions.size(); ++i) add(static_cast<int>(i), 0, 1, positions[i]);
        for (std::size_t k = 0; k < images; ++k) {
            const Image image = images_[k];  // images_ grows
            if (image.borders < 3) add(image.particle, image.turn, image.borders + 1, image.position);
        }
    }
    return images_;
}

/// Images are behind walls. A little more, as both are rounded.
template <class Real>
bool Images<Real>::reaches_walls(const Vector& x, Real distance) const {
    for (const Border& border : borders_)
        if (!(border.shift > 0) && border.normal.dot(x) + border.offset < Real(1.001) * distance) return true;
    return false;
}

template class Images<float>;
template class Images<double>;

}  // namespace natator::cpu
