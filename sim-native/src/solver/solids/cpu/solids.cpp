#include "solids.h"

#include <algorithm>
#include <numeric>

namespace natator::cpu {

double overlap_acceleration(const SolverParameters& p) {
    return std::min(std::max(p.max_acceleration, 10 * p.gravity.norm()), 1e30);
}

std::vector<std::vector<int>> free_bodies(const Model& model) {
    std::vector<int> parent(model.particles());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](int i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Spring& spring : model.springs) parent[root(spring.a)] = root(spring.b);
    for (const Cluster& cluster : model.clusters)
        for (const int i : cluster.particles) parent[root(i)] = root(cluster.particles.front());

    std::vector<std::vector<int>> members(model.particles());
    std::vector<bool> held(model.particles(), false);
    for (int i = 0; i < model.particles(); ++i) {
        members[root(i)].push_back(i);
        if (model.inverse_mass[i] == 0) held[root(i)] = true;
    }
    std::vector<std::vector<int>> bodies;
    for (int i = 0; i < model.particles(); ++i)
        if (members[i].size() > 1 && !held[i]) bodies.push_back(members[i]);
    return bodies;
}

template <class Real>
std::vector<SplitCluster<Real>> split_clusters(const Model& model) {
    std::vector<int> clusters_per_particle(model.particles(), 0);
    for (const Cluster& cluster : model.clusters)
        for (const int i : cluster.particles) ++clusters_per_particle[i];
    std::vector<SplitCluster<Real>> result;
    for (const Cluster& cluster : model.clusters) {
        SplitCluster<Real> split;
        Vector3<double> mean = Vector3<double>::Zero();
        double total = 0;
        for (std::size_t m = 0; m < cluster.particles.size(); ++m) {
            const double w = model.inverse_mass[cluster.particles[m]];
            const double mass = (w > 0 ? 1 / w : 1.0) / clusters_per_particle[cluster.particles[m]];
            split.mass.push_back(static_cast<Real>(mass));
            split.offset.push_back(cluster.rest_offset[m].template cast<Real>());
            mean += mass * cluster.rest_offset[m];
            total += mass;
        }
        for (auto& offset : split.offset) offset -= (mean / total).template cast<Real>();
        result.push_back(std::move(split));
    }
    return result;
}

template std::vector<SplitCluster<float>> split_clusters(const Model&);
template std::vector<SplitCluster<double>> split_clusters(const Model&);

}  // namespace natator::cpu
