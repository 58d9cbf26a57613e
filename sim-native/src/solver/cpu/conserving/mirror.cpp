#include "mirror.h"

namespace natator::cpu {

template <class Real>
Mirror<Real>::Mirror(const Model& model) {
    for (const Plane& plane : model.planes)
        planes_.emplace_back(plane.normal.template cast<Real>(), static_cast<Real>(plane.offset));
}

template <class Real>
int Mirror<Real>::reflected(int reflection, int plane) {
    const auto [place, made] = next_.try_emplace({reflection, plane}, static_cast<int>(matrices_.size()));
    if (made) {
        const Vector& n = planes_[plane].first;
        matrices_.push_back((Matrix::Identity() - 2 * n * n.transpose()) * matrices_[reflection]);
    }
    return place->second;
}

/// One plane after the other, each of what is there by then.
template <class Real>
const std::vector<typename Mirror<Real>::Image>& Mirror<Real>::images_of(const std::vector<Vector>& positions,
                                                                         Real distance) {
    images_.clear();
    for (int plane = 0; plane < static_cast<int>(planes_.size()); ++plane) {
        const auto& [normal, offset] = planes_[plane];
        const auto add = [&, n = normal, d = offset](int particle, int reflection, int planes, const Vector& x) {
            const Real before = n.dot(x) + d;
            if (before >= 0 && before < distance)
                images_.push_back({particle, reflected(reflection, plane), planes, x - 2 * before * n});
        };
        const std::size_t images = images_.size();
        for (std::size_t i = 0; i < positions.size(); ++i) add(static_cast<int>(i), 0, 1, positions[i]);
        for (std::size_t k = 0; k < images; ++k) {
            const Image image = images_[k];  // images_ grows
            if (image.planes < 3) add(image.particle, image.reflection, image.planes + 1, image.position);
        }
    }
    return images_;
}

/// Images are behind planes. A little more, as both are rounded.
template <class Real>
bool Mirror<Real>::reaches_images(const Vector& x, Real distance) const {
    for (const auto& [normal, offset] : planes_)
        if (normal.dot(x) + offset < Real(1.001) * distance) return true;
    return false;
}

template class Mirror<float>;
template class Mirror<double>;

}  // namespace natator::cpu
