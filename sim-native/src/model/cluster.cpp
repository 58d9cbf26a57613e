#include "cluster.h"

namespace natator {

Cluster make_cluster(std::vector<int> particles, const std::vector<Eigen::Vector3d>& rest_position, double stiffness) {
    Cluster cluster;
    cluster.particles = std::move(particles);
    cluster.stiffness = stiffness;
    for (const int i : cluster.particles) cluster.centre += rest_position[i];
    cluster.centre /= static_cast<double>(cluster.particles.size());
    for (const int i : cluster.particles) cluster.rest_offset.push_back(rest_position[i] - cluster.centre);
    return cluster;
}

}  // namespace natator
