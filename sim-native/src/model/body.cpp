#include "body.h"

#include "cluster.h"

namespace natator {
namespace {

constexpr std::uint32_t body_phase = 1;  // group 1; no flags: body particles do not collide with each other

void add_slice(const Creature& creature, const BodyLayout& layout, int slice, Model& model) {
    const Slice& shape = creature.slices[slice];
    const int behind = static_cast<int>(creature.slices.size()) - 1 - slice;  // slices between this one and the rear
    const Eigen::Vector3d centre = creature.rear_centre + Eigen::Vector3d(behind * creature.spacing, 0, 0);

    std::vector<int> members;
    for (int iy = 0; iy < shape.height; ++iy) {
        for (int iz = 0; iz < shape.row(iy); ++iz) {
            const Eigen::Vector3d offset(0, iy - (shape.height - 1) / 2.0, iz - (shape.row(iy) - 1) / 2.0);
            members.push_back(layout.index(slice, iy, iz));
            model.position.push_back(centre + creature.spacing * offset);
            model.velocity.push_back(Eigen::Vector3d::Zero());
            model.inverse_mass.push_back(1 / creature.particle_mass);
            model.phase.push_back(body_phase);
        }
    }
    model.body.particles.insert(model.body.particles.end(), members.begin(), members.end());
    model.body.slices.push_back(std::move(members));
}

/// One cluster of the slices from `front` to `rear`, both included.
Cluster cluster_of_slices(const Model& model, int front, int rear, double stiffness) {
    std::vector<int> particles;
    for (int slice = front; slice <= rear; ++slice)
        particles.insert(particles.end(), model.body.slices[slice].begin(), model.body.slices[slice].end());
    return make_cluster(std::move(particles), model.position, stiffness);
}

}  // namespace

BodyLayout::BodyLayout(const Creature& creature) {
    first_.push_back(0);
    for (const Slice& slice : creature.slices) {
        first_row_.push_back(static_cast<int>(first_.size()) - 1);
        for (int iy = 0; iy < slice.height; ++iy) first_.push_back(first_.back() + slice.row(iy));
    }
}

void add_body(const Creature& creature, const BodyLayout& layout, Model& model) {
    const int last = static_cast<int>(creature.slices.size()) - 1;
    for (int slice = 0; slice <= last; ++slice) add_slice(creature, layout, slice, model);
    model.body.length = last * creature.spacing;

    int front = 0, cluster = 0;
    for (const int joint : creature.joints) {
        model.clusters.push_back(cluster_of_slices(model, front, joint, creature.stiffness_of_cluster(cluster++)));
        front = joint;
    }
    model.clusters.push_back(cluster_of_slices(model, front, last, creature.stiffness_of_cluster(cluster)));
}

}  // namespace natator
