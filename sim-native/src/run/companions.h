#pragma once

#include <vector>

#include "natator/evaluate.h"
#include "natator/measure.h"

namespace natator {

/// How far the companions have come from one State to another.
template <class Real>
std::vector<CompanionResult> companion_results(const Scene& scene, const Model& model, const State<Real>& start,
                                               const State<Real>& end) {
    std::vector<CompanionResult> results;
    for (std::size_t k = 0; k < model.companions.size(); ++k) {
        const Body& body = model.companions[k].body;
        const double distance = mean_x(body, end) + end.origin.x() - mean_x(body, start) - start.origin.x();
        results.push_back({scene.companions[k].creature.name, distance, course_of(model, body, end, distance)});
    }
    return results;
}

}  // namespace natator
