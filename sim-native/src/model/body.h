#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Index of a particle within a body: slices follow one another from the head, each by y, then z.
class BodyLayout {
public:
    explicit BodyLayout(const Creature& creature);

    int particles() const { return first_.back(); }
    int index(int slice, int iy, int iz) const { return first_[slice] + iy * slices_[slice].width + iz; }

private:
    const std::vector<Slice>& slices_;
    std::vector<int> first_;  ///< first particle of each slice, and one past the last
};

/// Adds the creature's particles, slices and clusters to a model without particles (thesis 2.2).
void add_body(const Creature& creature, const BodyLayout& layout, Model& model);

}  // namespace natator
