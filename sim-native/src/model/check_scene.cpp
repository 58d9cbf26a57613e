#include "check_scene.h"

#include <cmath>
#include <string>

#include "base/text.h"
#include "natator/error.h"
#include "solver_fields.h"

namespace natator {
namespace {

/// Refuses what is below a place of a scene, by the names that files have for it.
class Check {
public:
    explicit Check(std::string place) : place_(std::move(place)) {}

    Check at(const std::string& key) const { return Check(place_ + key); }

    void above_zero(const char* key, double value) const {
        if (!(value > 0) || std::isinf(value)) refuse(key, value, "a finite number above 0");
    }
    void zero_or_above(const char* key, double value) const {
        if (!(value >= 0) || std::isinf(value)) refuse(key, value, "a finite number of at least 0");
    }
    void at_least(const char* key, int least, int value) const {
        if (value < least) refuse(key, value, "at least " + std::to_string(least));
    }
    /// Of a list that may be empty.
    void length_if_any(const char* key, std::size_t size, std::size_t wanted) const {
        if (size > 0 && size != wanted)
            throw InputError(place_ + key + " has length " + std::to_string(size) + ": must have length " +
                             std::to_string(wanted));
    }
    void ascending(const char* key, const std::vector<int>& slices, int first, int last) const {
        for (std::size_t i = 0; i < slices.size(); first = slices[i++] + 1)
            if (slices[i] < first || slices[i] > last)
                refuse(std::string(key) + "[" + std::to_string(i) + "]", slices[i],
                       std::string("a slice in [") + std::to_string(first) + ", " + std::to_string(last) + "]");
    }
    [[noreturn]] void refuse(const std::string& key, double value, const std::string& must_be) const {
        throw InputError(place_ + key + " = " + number_text(value) + ": must be " + must_be);
    }

private:
    std::string place_;
};

void check_slice(const Slice& slice, const Check& check) {
    check.at_least("height", 1, slice.height);
    const auto rows = static_cast<std::size_t>(slice.height);
    check.length_if_any("rows", slice.rows.size(), rows);
    check.length_if_any("columns", slice.columns.size(), rows);
    if (!slice.columns.empty()) return;  // a row may have none
    for (int iy = 0; iy < slice.height; ++iy) check.at_least("width", 1, slice.row(iy));
}

void check_regions(const Creature& creature, const Check& check) {
    const Regions& regions = *creature.regions;
    const auto within = [&](const char* key, int value, std::size_t count) {
        if (value < 0 || static_cast<std::size_t>(value) >= count)
            check.refuse(key, value, "0 to " + std::to_string(static_cast<long>(count) - 1));
    };
    std::size_t particles = 0;
    for (const Slice& slice : creature.slices) particles += static_cast<std::size_t>(slice.particles());
    for (const std::vector<int>& cluster : regions.clusters) {
        check.at_least("regions.clusters: particles", 1, static_cast<int>(cluster.size()));
        for (const int particle : cluster) within("regions.clusters", particle, particles);
    }
    for (const Fibre& fibre : regions.fibres) {
        within("regions.fibres: front", fibre.front, particles);
        within("regions.fibres: rear", fibre.rear, particles);
        within("regions.fibres: actuator", fibre.actuator, regions.actuators.size());
    }
    if (regions.places.size() != regions.actuators.size())
        check.refuse("regions.places: length", static_cast<double>(regions.places.size()), "that of actuators");
    if (creature.skin && regions.skin.size() != creature.skin->vertices.size())
        check.refuse("regions.skin: length", static_cast<double>(regions.skin.size()), "that of the skin's vertices");
    for (const SkinWeight& weight : regions.skin) {
        within("regions.skin: cluster", weight.cluster, regions.clusters.size());
        within("regions.skin: other", weight.other, regions.clusters.size());
    }
}

void check_creature(const Creature& creature, const Check& check) {
    const int slices = static_cast<int>(creature.slices.size()), last = slices - 1;
    if (slices == 0) check.refuse("slices", slices, "at least one slice");
    for (int i = 0; i < slices; ++i) check_slice(creature.slices[i], check.at("slices[" + std::to_string(i) + "]."));
    check.ascending("joints", creature.joints, 1, last - 1);
    check.ascending("muscleSlices", creature.muscle_slices, 0, last);
    const auto gaps = static_cast<std::size_t>(creature.gaps());
    check.length_if_any("bend", creature.bends.size(), gaps);
    check.length_if_any("springStiffness", creature.spring_stiffnesses.size(), gaps);
    check.length_if_any("clusterStiffness", creature.cluster_stiffnesses.size(), creature.joints.size() + 1);
    if (creature.regions) check_regions(creature, check);
    check.above_zero("spacing", creature.spacing);
    check.above_zero("particleMass", creature.particle_mass);
    check.at_least("springsPerParticle", 1, creature.springs_per_particle);
    check.at_least("refinement", 1, creature.refinement);
}

void check_fluid(const FluidBlock& fluid, const Check& check) {
    for (const int count : fluid.count) check.at_least("count", 1, count);
    check.above_zero("spacing", fluid.spacing);
    check.above_zero("mass.bottom", fluid.bottom_mass);
    check.above_zero("mass.top", fluid.top_mass);
}

void check_settling(const Settling& settling, const Check& check) {
    check.at_least("updates", 0, settling.updates);
    check.above_zero("timeStep", settling.time_step);
    check.at_least("substeps", 1, settling.substeps);
}

void check_obstacle(const Obstacle& obstacle, const Check& check) {
    check.above_zero("spacing", obstacle.spacing);
    if (obstacle.shape == Obstacle::Shape::sphere) check.above_zero("radius", obstacle.radius);
    if (obstacle.shape == Obstacle::Shape::box)
        for (const double edge : obstacle.size) check.above_zero("size", edge);
}

/// Particles of water do not get through: in scheme `conserving` a wall whose particles are as far apart as they holds
/// them, and one of 1.1 times that does not; in `flex` one of twice that does, of three times not.
void check_tight(const Scene& scene, const Obstacle& obstacle, const fields::Place& place) {
    if (!scene.fluid || scene.scheme == Scheme::lattice) return;
    const bool flex = scene.scheme == Scheme::flex;
    const double most = (flex ? 2 : 1) * scene.fluid->spacing;
    if (obstacle.spacing > most * (1 + 1e-9))
        fields::refuse(
            place, obstacle.spacing,
            "at most " + number_text(most) + (flex ? ", twice" : ",") + " fluid.spacing, or water gets through");
}

}  // namespace

void check_scene(const Scene& scene) {
    const fields::Place place{"scene " + quoted(scene.name), ""};
    const Check check(place.document + ": ");
    check.zero_or_above("duration", scene.duration);
    check.above_zero("timeStep", scene.time_step);
    fields::check_solver(scene.solver, place.key("solver"));
    for (std::size_t k = 0; k < scene.planes.size(); ++k)
        fields::check_plane(scene.planes[k], place.key("planes").item(k));
    check_settling(scene.settling, check.at("settling."));
    if (scene.fluid) {
        check_fluid(*scene.fluid, check.at("fluid."));
        fields::check_water(scene, place);
    }
    if (scene.creature) check_creature(*scene.creature, check.at("creature."));
    for (std::size_t k = 0; k < scene.companions.size(); ++k)
        check_creature(scene.companions[k].creature, check.at("companions[" + std::to_string(k) + "].creature."));
    fields::check_bodies(scene, place);
    for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
        check_obstacle(scene.obstacles[k], check.at("obstacles[" + std::to_string(k) + "]."));
        check_tight(scene, scene.obstacles[k], place.key("obstacles").item(k).key("spacing"));
    }
}

}  // namespace natator
