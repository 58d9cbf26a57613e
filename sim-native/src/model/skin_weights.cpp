#include "skin_weights.h"

#include <algorithm>

namespace natator {

std::vector<SkinWeight> skin_weights(const Creature& creature, const Model& model) {
    if (creature.regions) return creature.regions->skin;
    std::vector<double> middles;  // x of each cluster from the centre of the last slice, falling from the head on
    for (const Cluster& cluster : model.clusters) {
        double low = model.position[cluster.particles.front()].x(), high = low;
        for (const int particle : cluster.particles) {
            low = std::min(low, model.position[particle].x());
            high = std::max(high, model.position[particle].x());
        }
        middles.push_back((low + high) / 2 - creature.rear_centre.x());
    }
    std::vector<SkinWeight> weights;
    for (const Eigen::Vector3d& vertex : creature.skin->vertices) {
        int cluster = 0;
        while (cluster + 1 < static_cast<int>(middles.size()) && vertex.x() <= middles[cluster + 1]) ++cluster;
        double share = 1;
        if (cluster + 1 < static_cast<int>(middles.size()))
            share =
                std::clamp((vertex.x() - middles[cluster + 1]) / (middles[cluster] - middles[cluster + 1]), 0.0, 1.0);
        weights.push_back({cluster, std::min(cluster + 1, static_cast<int>(middles.size()) - 1), share});
    }
    return weights;
}

}  // namespace natator
