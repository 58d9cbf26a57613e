#include "images.h"

#include "model/borders.h"
#include "solver/cpu/aligned.h"

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
const std::vector<typename Images<Real>::Image>& Images<Real>::of(const std::vector<Vector>& positions, Real distance,
                                                                  ThreadTeam& team) {
    constexpr int shortest_part = 2048;  // fewer are done before another thread is awake
    images_.clear();
    for (int border = 0; border < static_cast<int>(borders_.size()); ++border) {
        const auto add = [distance, through = borders_[border]](std::vector<Image>& to, int particle, int borders, const Vector& x,
                                                                const auto& turn) {
            const Real before = through.normal.dot(x) + through.offset;
            if (before >= 0 && before < distance)
                to.push_back({particle, turn(), borders, x + (through.shift > 0 ? through.shift : -2 * before) * through.normal});
        };
        const std::size_t images = images_.size();
        const int turn = turned(0, border);
        found_.resize(team.max_parts());
        for (std::vector<Image>& found : found_) found.clear();
        team.for_parts(static_cast<int>(positions.size()), shortest_part, [&](int part, int begin, int end) {
            for (int i = begin; i < end; ++i) add(found_[part], i, 1, positions[i], [turn] { return turn; });
        });
        for (const std::vector<Image>& found : found_) images_.insert(images_.end(), found.begin(), found.end());
        for (std::size_t k = 0; k < images; ++k) {
            const Image image = images_[k];  // images_ grows
            if (image.borders < 3)
                add(images_, image.particle, image.borders + 1, image.position, [&] { return turned(image.turn, border); });
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
