#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Index of a particle within a body: slices follow one another from the head, each by y, then z.
class BodyLayout {
public:
    explicit BodyLayout(const Creature& creature);

    int particles() const { return first_.back(); }
    int index(int slice, int iy, int iz) const { return first_[first_row_[slice] + iy] + iz; }

private:
    std::vector<int> first_;      ///< first particle of each row of all slices, and one past the last
    std::vector<int> first_row_;  ///< place in `first_` of each slice's lowest row
};

/// Adds the creature's particles, slices and clusters to a model without particles (thesis 2.2).
void add_body(const Creature& creature, const BodyLayout& layout, Model& model);

}  // namespace natator
