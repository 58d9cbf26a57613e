#include "body.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

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
            const Eigen::Vector3d offset(0, shape.y(iy) / 2.0, shape.z(iy, iz) / 2.0);
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

/// What a cluster takes of the slice that it begins with and shares: all of it, or the particles nearest the line about
/// which the body bends there.
std::vector<int> shared_particles(const Creature& creature, const Model& model, int slice) {
    const std::vector<int>& members = model.body.slices[slice];
    if (creature.joint == Joint::slice) return members;
    const Slice& shape = creature.slices[slice];
    const bool vertical = creature.bends_by(Bend::vertical);
    const bool sideways = creature.bends_by(Bend::sideways) || !vertical;
    const auto from_line = [&](int iy, int iz) {  // half spacings
        return std::max(sideways ? std::abs(shape.z(iy, iz)) : 0, vertical ? std::abs(shape.y(iy) - shape.lift) : 0);
    };
    int nearest = std::numeric_limits<int>::max();
    for (int iy = 0; iy < shape.height; ++iy)
        for (int iz = 0; iz < shape.row(iy); ++iz) nearest = std::min(nearest, from_line(iy, iz));
    std::vector<int> shared;
    int member = 0;
    for (int iy = 0; iy < shape.height; ++iy)
        for (int iz = 0; iz < shape.row(iy); ++iz, ++member)
            if (from_line(iy, iz) == nearest) shared.push_back(members[member]);
    return shared;
}

/// One cluster of what it shares with the one before it, if anything, and the slices from `first` to `rear`, both
/// included.
Cluster cluster_of_slices(const Model& model, std::vector<int> shared, int first, int rear, double stiffness) {
    std::vector<int> particles = std::move(shared);
    for (int slice = first; slice <= rear; ++slice)
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
    model.body.length = creature.length();
    model.body.spacing = creature.spacing;

    if (creature.regions) {
        for (const std::vector<int>& particles : creature.regions->clusters)
            model.clusters.push_back(make_cluster(particles, model.position, creature.cluster_stiffness));
        return;
    }
    std::vector<int> shared;
    int first = 0, cluster = 0;
    for (const int joint : creature.joints) {
        model.clusters.push_back(
            cluster_of_slices(model, std::move(shared), first, joint, creature.stiffness_of_cluster(cluster++)));
        shared = shared_particles(creature, model, joint);
        first = joint + 1;
    }
    model.clusters.push_back(
        cluster_of_slices(model, std::move(shared), first, last, creature.stiffness_of_cluster(cluster)));
}

}  // namespace natator
