#include "refine_body.h"

#include "cluster.h"

namespace natator {
namespace {

/// From a particle to those that it is made of, length.
std::vector<Eigen::Vector3d> places_of_parts(const Creature& creature, bool plane) {
    const int n = creature.refinement, high = plane ? 1 : n;
    const Eigen::Vector3d middle = Eigen::Vector3d(n - 1, high - 1, n - 1) / 2;
    std::vector<Eigen::Vector3d> places;
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < high; ++y)
            for (int z = 0; z < n; ++z) places.push_back(creature.spacing / n * (Eigen::Vector3d(x, y, z) - middle));
    return places;
}

/// Those that the particles are made of, particle by particle.
std::vector<int> parts_of(const std::vector<int>& particles, int parts) {
    std::vector<int> all;
    for (const int particle : particles)
        for (int part = 0; part < parts; ++part) all.push_back(particle * parts + part);
    return all;
}

template <class T>
std::vector<T> repeated(const std::vector<T>& values, int times) {
    std::vector<T> all;
    for (const T& value : values) all.insert(all.end(), static_cast<std::size_t>(times), value);
    return all;
}

/// Half the width, or the height, of each particle's slice, length.
std::vector<double> half_extents(const Creature& creature, const Model& model, Bend bend) {
    std::vector<double> extents(model.position.size());
    for (std::size_t slice = 0; slice < model.body.slices.size(); ++slice) {
        const Slice& shape = creature.slices[slice];
        for (const int particle : model.body.slices[slice])
            extents[particle] = creature.spacing * ((bend == Bend::sideways ? shape.width : shape.height) - 1) / 2;
    }
    return extents;
}

/// Springs stay sorted by actuator and front particle: those of one front particle are divided together. Every spring
/// of a body is a muscle's, in the same order.
void divide_muscles(const Creature& creature, const std::vector<Eigen::Vector3d>& places, Model& model) {
    const std::vector<Actuator> actuators = creature.actuator_list();
    const std::vector<double> half_widths = half_extents(creature, model, Bend::sideways);
    const std::vector<double> half_heights = half_extents(creature, model, Bend::vertical);
    const std::vector<Spring> springs = std::move(model.springs);
    const std::vector<Muscle> muscles = std::move(model.muscles);
    model.springs.clear();
    model.muscles.clear();
    const auto parts = static_cast<int>(places.size());
    for (std::size_t first = 0, last = 0; first < muscles.size(); first = last) {
        const int front = springs[muscles[first].spring].a;
        while (last < muscles.size() && springs[muscles[last].spring].a == front &&
               muscles[last].actuator == muscles[first].actuator)
            ++last;
        for (int part = 0; part < parts; ++part)
            for (std::size_t k = first; k < last; ++k) {
                const Spring& whole = springs[muscles[k].spring];
                const bool sideways = actuators[static_cast<std::size_t>(muscles[k].actuator)].bend == Bend::sideways;
                const std::vector<double>& half = sideways ? half_widths : half_heights;
                const double z = sideways ? places[part].z() : places[part].y();
                const double across = creature.regions ? 0 : (z / half[whole.a] + z / half[whole.b]) / 2;
                const double lateral = muscles[k].lateral + across;
                model.muscles.push_back({static_cast<int>(model.springs.size()), muscles[k].actuator, lateral});
                model.springs.push_back(
                    {whole.a * parts + part, whole.b * parts + part, whole.rest_length, whole.stiffness});
            }
    }
}

}  // namespace

void refine_body(const Creature& creature, bool plane, Model& model) {
    if (creature.refinement == 1) return;
    const std::vector<Eigen::Vector3d> places = places_of_parts(creature, plane);
    const auto parts = static_cast<int>(places.size());
    divide_muscles(creature, places, model);

    const std::vector<Eigen::Vector3d> whole = std::move(model.position);
    model.position.clear();
    for (const Eigen::Vector3d& centre : whole)
        for (const Eigen::Vector3d& place : places) model.position.push_back(centre + place);
    for (double& inverse_mass : model.inverse_mass) inverse_mass *= parts;
    model.inverse_mass = repeated(model.inverse_mass, parts);
    model.velocity = repeated(model.velocity, parts);
    model.phase = repeated(model.phase, parts);

    model.body.particles = parts_of(model.body.particles, parts);
    model.body.spacing /= creature.refinement;
    for (std::vector<int>& slice : model.body.slices) slice = parts_of(slice, parts);
    for (Cluster& cluster : model.clusters)
        cluster = make_cluster(parts_of(cluster.particles, parts), model.position, cluster.stiffness);
}

}  // namespace natator
